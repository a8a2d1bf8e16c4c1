#include <heddle/job/write_output.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/file/output_file.h>
#include <heddle/job/option_error.h>

#include <filesystem>

namespace heddle::job {

void check_output(const std::string& path, const std::string& suffix, const std::string& option) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    // OutputFile can write to a device, but a .vdb needs seeks, so devices are refused here
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
        throw Error(ErrorCode::CannotWrite, "this is a folder or a device, not a file",
                    "name a file", {.path = path});
    }
    if (suffix_of(path) != suffix) {
        throw OptionError(str("`", option, "`: '", path, "' must end in ", suffix));
    }
    write_output([&path] { const OutputFile probe(path); });
}

void write_output(const std::function<void()>& write) {
    try {
        write();
    } catch (const Error& e) {
        switch (e.code()) {
        case ErrorCode::Cancelled:
        case ErrorCode::OutOfMemory:
        case ErrorCode::Internal: throw;
        default: throw Error(ErrorCode::CannotWrite, e.what());
        }
    }
}

void write_text(const std::string& path, std::string_view text) {
    write_output([&] {
        OutputFile file(path);
        file.write(text.data(), text.size());
        file.commit();
    });
}

std::int64_t file_bytes(const std::string& path) {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(path, ignored);
    return ignored ? 0 : static_cast<std::int64_t>(size);
}

} // namespace heddle::job

#pragma once

#include <heddle/base/error.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace heddle::job {

/// A temporary folder for the files whose size is measured. The destructor removes it.
class ScratchFolder {
public:
    /// @throws Error  CannotWrite
    ScratchFolder() {
        std::error_code none;
        std::string name = (std::filesystem::temp_directory_path(none) / "heddle-XXXXXX").string();
        if (none || ::mkdtemp(name.data()) == nullptr) {
            throw Error(ErrorCode::CannotWrite,
                        "lod-report: cannot create a folder for temporary files",
                        "set TMPDIR to a writable folder");
        }
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] std::string file() const { return (path_ / "levels.vdb").string(); }

private:
    std::filesystem::path path_;
};

} // namespace heddle::job

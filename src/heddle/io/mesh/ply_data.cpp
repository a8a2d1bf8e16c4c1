#include <heddle/io/mesh/ply_data.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

namespace heddle {
namespace {

constexpr std::size_t kMaxHeaderLine = 4096;
constexpr std::size_t kMaxProperties = 4096;

std::optional<PlyType> type_from_name(std::string_view name) {
    constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                     {"uchar", "uint8"},
                                                                     {"short", "int16"},
                                                                     {"ushort", "uint16"},
                                                                     {"int", "int32"},
                                                                     {"uint", "uint32"},
                                                                     {"float", "float32"},
                                                                     {"double", "float64"}}};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<PlyType>(i);
    }
    return std::nullopt;
}

std::size_t size_of(PlyType type) {
    constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

template <typename T>
double value_of(const std::array<std::byte, 8>& raw) {
    T value{};
    std::memcpy(&value, raw.data(), sizeof value);
    return static_cast<double>(value);
}

/// @param raw  the value's bytes in the machine's order, at the front
double decode(PlyType type, const std::array<std::byte, 8>& raw) {
    switch (type) {
    case PlyType::I8: return value_of<std::int8_t>(raw);
    case PlyType::U8: return value_of<std::uint8_t>(raw);
    case PlyType::I16: return value_of<std::int16_t>(raw);
    case PlyType::U16: return value_of<std::uint16_t>(raw);
    case PlyType::I32: return value_of<std::int32_t>(raw);
    case PlyType::U32: return value_of<std::uint32_t>(raw);
    case PlyType::F32: return value_of<float>(raw);
    case PlyType::F64: return value_of<double>(raw);
    }
    return 0.0;
}

bool is_blank(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

} // namespace

int PlyElement::find(std::initializer_list<const char*> names) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
        for (const char* wanted : names) {
            if (properties[i].name == wanted) return static_cast<int>(i);
        }
    }
    return -1;
}

PlyData::PlyData(const std::filesystem::path& path)
    : path_(path.string()), text_(read_whole_file(path.string(), kAnySize)) {
    read_header();
}

void PlyData::fail(const std::string& what) const {
    Where where{.path = path_};
    if (format_ == PlyFormat::Ascii) {
        const auto here = text_.begin() + static_cast<std::ptrdiff_t>(at_);
        where.line = 1 + std::count(text_.begin(), here, '\n');
    } else {
        where.offset = static_cast<std::int64_t>(at_);
    }
    throw Error(ErrorCode::BadFile, what, "export the file again", where);
}

void PlyData::read_header() {
    const std::string_view text = text_;
    if (text.substr(0, 3) != "ply" || text.size() < 4 || !is_blank(text_[3]))
        fail("does not begin with 'ply'");
    at_ = std::min(text.find('\n'), text.size() - 1) + 1;
    while (true) {
        const std::size_t end = text.find('\n', at_);
        if (end == std::string_view::npos || end - at_ > kMaxHeaderLine)
            fail("the header has no 'end_header'");
        std::string line(text.substr(at_, end - at_));
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line == "end_header") {
            if (!has_format_) fail("the header names no format");
            at_ = end + 1;
            return;
        }
        read_header_line(line);
        at_ = end + 1;
    }
}

void PlyData::read_header_line(const std::string& line) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return;
    if (keyword == "format") {
        std::string name;
        words >> name;
        if (name == "binary_little_endian")
            format_ = PlyFormat::LittleEndian;
        else if (name == "binary_big_endian")
            format_ = PlyFormat::BigEndian;
        else if (name != "ascii")
            fail(str("unknown format '", name, "'"));
        has_format_ = true;
    } else if (keyword == "element") {
        PlyElement element;
        std::string count;
        words >> element.name >> count;
        const auto [end, error] =
            std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (error != std::errc{} || end != count.data() + count.size())
            fail(str("element '", element.name, "' has the count '", count, "'"));
        elements_.push_back(std::move(element));
    } else if (keyword == "property") {
        if (elements_.empty()) fail("a property comes before the first element");
        if (elements_.back().properties.size() == kMaxProperties)
            fail(str("an element has more than ", kMaxProperties, " properties"));
        std::array<std::string, 4> word;
        for (std::string& w : word) words >> w;
        const bool is_list = word[0] == "list";
        const auto type = type_from_name(is_list ? word[2] : word[0]);
        const auto count_type = is_list ? type_from_name(word[1]) : PlyType::U8;
        const std::string& name = is_list ? word[3] : word[1];
        if (!type || !count_type || name.empty()) fail(str("cannot read '", line, "'"));
        elements_.back().properties.push_back({name, *type, is_list, *count_type});
    } else {
        fail(str("unknown header keyword '", keyword, "'"));
    }
}

double PlyData::next_number() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    if (at_ == text_.size()) fail("ends before its last value");
    const char* start = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    if (*start == '+') ++start;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(start, end, value);
    if (error != std::errc{} || (stop != end && !is_blank(*stop))) {
        const char* word = std::find_if(start, end, is_blank);
        fail(str("'", std::string(start, std::min(word, start + 40)), "' is not a number"));
    }
    at_ = static_cast<std::size_t>(stop - text_.data());
    return value;
}

double PlyData::next(PlyType type) {
    if (format_ == PlyFormat::Ascii) return next_number();
    const std::size_t size = size_of(type);
    if (text_.size() - at_ < size) fail("ends before its last value");
    std::array<std::byte, 8> raw{};
    std::memcpy(raw.data(), text_.data() + at_, size);
    const bool is_little = format_ == PlyFormat::LittleEndian;
    if (is_little != (std::endian::native == std::endian::little))
        std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    at_ += size;
    return decode(type, raw);
}

std::uint64_t PlyData::least_bytes(PlyType type) const {
    return format_ == PlyFormat::Ascii ? 2 : size_of(type); // a digit and a separator
}

std::uint64_t PlyData::next_count(const PlyProperty& property) {
    const double count = next(property.count_type);
    const std::uint64_t left = text_.size() - at_ + 1; // a text's last number ends with it
    if (!(count >= 0.0) || count != std::floor(count) ||
        count * static_cast<double>(least_bytes(property.type)) > static_cast<double>(left))
        fail(str("list '", property.name, "' has the length ", count, ", and only ", left - 1,
                 " bytes are left"));
    return static_cast<std::uint64_t>(count);
}

void PlyData::skip(const PlyProperty& property) {
    const std::uint64_t count = property.is_list ? next_count(property) : 1;
    for (std::uint64_t i = 0; i < count; ++i) (void)next(property.type);
}

void PlyData::check_rows(const PlyElement& element) const {
    std::uint64_t row = 0;
    for (const PlyProperty& p : element.properties)
        row += least_bytes(p.is_list ? p.count_type : p.type);
    const std::uint64_t left = text_.size() - at_ + 1;
    if (row > 0 && element.count > left / row)
        fail(str("says ", element.count, " rows of '", element.name, "' of ", row,
                 " bytes or more, and only ", left - 1, " bytes are left"));
}

} // namespace heddle

#include "core/observe/recording.h"

#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "core/base/text_file.h"
#include "core/observe/hdf5_recording.h"

namespace forage::observe {
namespace {

/// The name without ".part".
std::filesystem::path final_name(const std::string& path) {
    return path.ends_with(".part") ? path.substr(0, path.size() - 5) : path;
}

[[noreturn]] void no_recording(const std::string& path, const std::string& why) {
    throw FileError(path, {}, {error_at(0, 0, "this is no recording: " + why)});
}

/// A group of more cells does not fit into memory anyway; a damaged file may say anything.
constexpr std::int64_t most_cells = 1 << 24;

void open(std::ifstream& in, const std::string& path) {
    std::error_code none;
    if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none))
        no_recording(path, "it is no file, but a directory, a pipe or a device");
    in.open(path, std::ios::binary);
    if (!in)
        throw FileError(path, {},
                        {error_at(0, 0, fmt::format("cannot read the file: {}", std::strerror(errno)))});
}

std::vector<std::string_view> fields(std::string_view line, char separator) {
    std::vector<std::string_view> out;
    for (std::size_t at = 0;;) {
        const auto end = std::min(line.find(separator, at), line.size());
        out.push_back(line.substr(at, end - at));
        if (end == line.size()) return out;
        at = end + 1;
    }
}

/// "x3_y1"
bool parse_place(std::string_view text, int& x, int& y) {
    const char* end = text.data() + text.size();
    if (!text.starts_with('x')) return false;
    const auto first = std::from_chars(text.data() + 1, end, x);
    if (first.ec != std::errc() || end - first.ptr < 3 || first.ptr[0] != '_' || first.ptr[1] != 'y')
        return false;
    const auto second = std::from_chars(first.ptr + 2, end, y);
    return second.ec == std::errc() && second.ptr == end;
}

class CsvRecording final : public Recording {
  public:
    explicit CsvRecording(const std::string& path) : path_(path) {
        open(in_, path);
        what_.name = final_name(path).stem().string();
        if (!line()) no_recording(path, "its first line is not complete");
        const auto names = fields(line_, ',');
        if (names.size() < 2 || names[0] != "cycle") no_recording(path, "its first column is not 'cycle'");
        columns_ = names.size() - 1;
        body_ = in_.tellg();
        what_.cells = {1, 1, static_cast<int>(columns_), 1, {}};
        what_.mean = names[1] == "mean";
        int x = 0, y = 0;
        if (what_.mean && columns_ > 1)
            bad(names[2].data() - line_.data() + 1,
                fmt::format("a mean is one column, and here are {}", columns_));
        if (what_.mean) return;
        if (!parse_place(names[1], x, y)) {
            what_.numbered = true;
            return;
        }
        int right = 0, below = 0;
        if (!parse_place(names.back(), right, below))
            no_recording(path, "its columns are not those of a group");
        const auto width = std::int64_t{right} - x + 1, height = std::int64_t{below} - y + 1;
        if (x < 1 || y < 1 || width < 1 || height < 1 || width > most_cells || height > most_cells ||
            width * height != static_cast<std::int64_t>(columns_))
            no_recording(path, "its columns are not those of a group");
        what_.cells = {x, y, static_cast<int>(width), static_cast<int>(height), {}};
        for (std::size_t i = 0; i < columns_; ++i)
            if (names[i + 1] != what_.cell_name(i))
                bad(names[i + 1].data() - line_.data() + 1,
                    fmt::format("this column's name is '{}', and '{}' is expected", escaped(names[i + 1]),
                                what_.cell_name(i)));
    }

    void rewind() override {
        in_.clear();
        in_.seekg(body_);
        number_ = 1;
    }

    bool next(std::uint64_t& cycle, std::vector<double>& numbers) override {
        if (!line()) return false;
        const auto texts = fields(line_, ',');
        if (texts.size() != columns_ + 1)
            bad(1, fmt::format("{} numbers in a row, not {}", texts.size(), columns_ + 1));
        const auto number = [&](std::string_view text, auto& out) {
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
            if (error != std::errc() || end != text.data() + text.size())
                bad(text.data() - line_.data() + 1, fmt::format("'{}' is not a number", escaped(text)));
        };
        number(texts[0], cycle);
        numbers.resize(columns_);
        for (std::size_t i = 0; i < columns_; ++i) number(texts[i + 1], numbers[i]);
        return true;
    }

  private:
    /// The next complete line: what a killed program left of a row does not count.
    bool line() {
        ++number_;
        line_.clear();
        // In blocks: what is no recording may be one line without an end.
        for (;;) {
            in_.getline(block_.data(), static_cast<std::streamsize>(block_.size()));
            const auto count = static_cast<std::size_t>(in_.gcount());
            if (in_.eof() || in_.bad()) return false;
            if (!in_.fail()) {
                line_.append(block_.data(), count - 1);  // '\n' is counted, and not stored
                break;
            }
            line_.append(block_.data(), count);
            if (line_.size() > longest_line) bad(1, "the line is too long");
            in_.clear();
        }
        if (line_.ends_with('\r')) line_.pop_back();
        return true;
    }
    [[noreturn]] void bad(std::ptrdiff_t column, const std::string& why) {
        throw FileError(path_, {}, {error_at(static_cast<int>(number_), static_cast<int>(column), why)});
    }

    static constexpr std::size_t longest_line = 64 << 20;
    std::vector<char> block_ = std::vector<char>(1 << 16);

    std::string path_, line_;
    std::ifstream in_;
    std::streampos body_;
    std::size_t columns_ = 0, number_ = 0;
};

class NpyRecording final : public Recording {
  public:
    explicit NpyRecording(const std::string& path) {
        open(in_, path);
        what_.name = final_name(path).stem().string();
        char start[10] = {};
        in_.read(start, sizeof start);
        if (!in_ || std::string_view(start, 8) != std::string_view("\x93NUMPY\x01\x00", 8))
            no_recording(path, "it does not begin as NumPy's files, version 1");
        std::string head(static_cast<std::size_t>(static_cast<unsigned char>(start[8]) |
                                                  static_cast<unsigned char>(start[9]) << 8),
                         ' ');
        in_.read(head.data(), static_cast<std::streamsize>(head.size()));
        // Of what NumPy may say, only what npy_file.cpp writes.
        int width = 1, height = 1, fields_read = 0;
        char state[256] = {};
        const auto type = head.find("('", head.find("<u8"));
        if (type != std::string::npos)
            fields_read =
                std::sscanf(head.c_str() + type, "('%255[^']', '<f8', (%d, %d))", state, &height, &width);
        const auto shape = head.find("'shape': (");
        if ((fields_read != 1 && fields_read != 3) || shape == std::string::npos || width < 1 || height < 1)
            no_recording(path, "its records are not a cycle and numbers");
        if (std::int64_t{width} * height > most_cells) no_recording(path, "it has too many cells");
        what_.state = state;
        what_.mean = fields_read == 1;
        what_.cells = {1, 1, width, height, {}};
        if (!std::isdigit(static_cast<unsigned char>(head[shape + 10])))
            no_recording(path, "it does not say how many rows it has");
        rows_ = std::strtoull(head.c_str() + shape + 10, nullptr, 10);
        path_ = path;
        body_ = in_.tellg();
    }

    void rewind() override {
        in_.clear();
        in_.seekg(body_);
        row_ = 0;
    }

    bool next(std::uint64_t& cycle, std::vector<double>& numbers) override {
        if (row_ == rows_) return false;
        ++row_;
        numbers.resize(what_.size());
        in_.read(reinterpret_cast<char*>(&cycle), sizeof cycle);
        in_.read(reinterpret_cast<char*>(numbers.data()),
                 static_cast<std::streamsize>(numbers.size() * sizeof(double)));
        if (!in_)
            throw FileError(path_, {}, {error_at(0, 0, fmt::format("it ends in row {} of {}", row_, rows_))});
        return true;
    }

  private:
    std::string path_;
    std::ifstream in_;
    std::streampos body_;
    std::uint64_t rows_ = 0, row_ = 0;
};

}  // namespace

bool is_recording(const std::string& path) {
    const auto extension = final_name(path).extension();
    return extension == ".csv" || extension == ".npy" || extension == ".h5";
}

std::vector<std::unique_ptr<Recording>> open_recording(const std::string& path) {
    const auto extension = final_name(path).extension();
    std::vector<std::unique_ptr<Recording>> out;
    if (extension == ".h5") return open_hdf5_recording(path);
    if (extension == ".npy")
        out.push_back(std::make_unique<NpyRecording>(path));
    else if (extension == ".csv")
        out.push_back(std::make_unique<CsvRecording>(path));
    else
        no_recording(path, "its name ends neither in .csv nor in .npy nor in .h5");
    return out;
}

}  // namespace forage::observe

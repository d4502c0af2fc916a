#include "core/observe/recording.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "core/base/table.h"
#include "core/observe/hdf5_recording.h"
#include "core/observe/zip_file.h"

namespace forage::observe {
namespace {

/// The name without ".part".
std::filesystem::path final_name(const std::string& path) {
    return path.ends_with(".part") ? path.substr(0, path.size() - 5) : path;
}

[[noreturn]] void no_recording(const std::string& path, const std::string& why) {
    throw FileError(path, {}, {error_at(0, 0, "this is not a recording: " + why)});
}

/// The largest accepted number of cells. A damaged file may contain any number.
constexpr std::int64_t max_cells = 1 << 24;

/// The column and row of a cell with the name "x3_y1".
std::optional<std::pair<int, int>> parse_place(std::string_view name) {
    const auto part = [&](std::string_view before) -> std::optional<int> {
        if (!name.starts_with(before)) return std::nullopt;
        name.remove_prefix(before.size());
        return take_number<int>(name);
    };
    const auto x = part("x");
    const auto y = x ? part("_y") : std::nullopt;
    return y && name.empty() ? std::optional(std::pair(*x, *y)) : std::nullopt;
}

class CsvRecording final : public Recording {
  public:
    explicit CsvRecording(const std::string& path) : path_(path) {
        rewind();
        what_.name = final_name(path).stem().string();
        const auto& names = rows_->fields();
        if (names.size() < 2 || names[0] != "cycle") no_recording(path, "its first column is not 'cycle'");
        const std::size_t columns = names.size() - 1;
        what_.cells = {1, 1, static_cast<int>(columns), 1, {}};
        for (const auto reduction : expression::reductions)
            if (names[1] == reduction) what_.reduction = reduction;
        if (what_.one_number() && columns > 1)
            rows_->fault(names[2], fmt::format("a {} is one column, and here are {}", names[1], columns));
        const auto first = parse_place(names[1]), last = parse_place(names.back());
        what_.numbered = !what_.one_number() && !first;
        if (first) {
            const auto [x, y] = *first;
            const auto width = last ? std::int64_t{last->first} - x + 1 : 0,
                       height = last ? std::int64_t{last->second} - y + 1 : 0;
            if (x < 1 || y < 1 || width < 1 || height < 1 || width > max_cells || height > max_cells ||
                width * height != static_cast<std::int64_t>(columns))
                no_recording(path, "its columns are not those of a group");
            what_.cells = {x, y, static_cast<int>(width), static_cast<int>(height), {}};
            for (std::size_t i = 0; i < columns; ++i)
                if (names[i + 1] != what_.cell_name(i))
                    rows_->fault(names[i + 1], fmt::format("this column's name is '{}', and '{}' is expected",
                                                           escaped(names[i + 1]), what_.cell_name(i)));
        }
        rows_->require_sound();
    }

    void rewind() override {
        rows_.emplace(open_file(path_), path_);
        if (rows_->read_header()) return;
        rows_->require_sound();
        no_recording(path_, "its first line is not complete");
    }

    bool next(std::uint64_t& cycle, std::vector<double>& numbers) override {
        while (rows_->next()) {  // after a fault, only to find others
            const auto& fields = rows_->fields();
            const auto read = parse_number<std::uint64_t>(fields[0]);
            if (!read)
                rows_->fault(fields[0], fmt::format("'{}' is not the number of a cycle", escaped(fields[0])));
            cycle = read.value_or(0);
            numbers.clear();
            for (std::size_t i = 1; i < fields.size(); ++i) {
                auto rest = fields[i];
                const auto number = take_number<double>(rest);  // may be NaN
                if ((!number || !rest.empty()) && !rows_->full())
                    rows_->fault(fields[i], no_number(fields[i]));
                numbers.push_back(number.value_or(0));
            }
            if (!rows_->failed()) return true;
        }
        rows_->require_sound();
        return false;
    }

  private:
    std::string path_;
    std::optional<TableReader> rows_;
};

class NpyRecording final : public Recording {
  public:
    /// Reads `file`. Messages name `path`, which is the archive if the file was in one.
    NpyRecording(const std::string& file, const std::string& path, std::string name)
        : path_(path), in_(open_file(file)) {
        what_.name = std::move(name);
        char start[10] = {};
        in_.read(start, sizeof start);
        if (!in_ || std::string_view(start, 8) != std::string_view("\x93NUMPY\x01\x00", 8))
            no_recording(path, "it does not begin as NumPy's files, version 1");
        std::string head(static_cast<std::size_t>(static_cast<unsigned char>(start[8]) |
                                                  static_cast<unsigned char>(start[9]) << 8),
                         ' ');
        in_.read(head.data(), static_cast<std::streamsize>(head.size()));
        // Only headers as npy_file.cpp writes them are accepted: "('act', '<f8', (height, width))], ...
        // 'shape': (rows,)".
        std::string_view rest = head;
        const auto take = [&](std::string_view text) {
            const bool there = rest.starts_with(text);
            if (there) rest.remove_prefix(text.size());
            return there;
        };
        const auto go_behind = [&](std::string_view text) {
            const auto at = rest.find(text);
            if (at != rest.npos) rest.remove_prefix(at + text.size());
            return at != rest.npos;
        };
        std::optional<int> height = 1, width = 1;
        bool known = go_behind("[('cycle', '<u8'), ('");
        what_.state = rest.substr(0, std::min(rest.find('\''), rest.size()));
        rest.remove_prefix(what_.state.size());
        known = known && take("', '<f8'");
        const bool one = !take(", (");
        if (one) what_.reduction = "mean";  // or the maximum: such a file does not say which
        if (!one) height = take_number<int>(rest), width = take(", ") ? take_number<int>(rest) : 0;
        known = known && (one || take(")")) && take(")]") && go_behind("'shape': (");
        if (!known || !(height > 0) || !(width > 0))
            no_recording(path, "its records are not a cycle and numbers");
        if (std::int64_t{*width} * *height > max_cells) no_recording(path, "it has too many cells");
        what_.cells = {1, 1, *width, *height, {}};
        const auto rows = take_number<std::uint64_t>(rest);
        if (!rows || !take(",)")) no_recording(path, "it does not say how many rows it has");
        rows_ = *rows;
        body_ = in_.tellg();
        const auto bytes = std::filesystem::file_size(file), row = 8 * (1 + std::uint64_t{what_.size()});
        if (rows_ > (bytes - std::min<std::uint64_t>(bytes, 10 + head.size())) / row)
            throw FileError(path, {},
                            {error_at(0, 0,
                                      fmt::format("it has {} bytes, too few for {} rows of {} cells", bytes,
                                                  rows_, what_.size()))});
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

/// The arrays of an .npz file. Each is unpacked into a temporary file, of which the name is removed at once.
std::vector<std::unique_ptr<Recording>> open_npz(const std::string& path) {
    namespace fs = std::filesystem;
    std::vector<std::unique_ptr<Recording>> out;
    std::string folder = (fs::temp_directory_path() / "forage-XXXXXX").string();
    if (!mkdtemp(folder.data())) no_recording(path, "there is no temporary folder in which to unpack it");
    const auto remove = [](const std::string* f) {
        std::error_code ignored;
        fs::remove_all(*f, ignored);
    };
    const std::unique_ptr<std::string, decltype(remove)> remover(&folder, remove);
    try {
        const ZipFile archive(path);
        for (const auto& entry : archive.entries()) {
            const fs::path name = entry.name;
            if (name.extension() != ".npy") continue;
            archive.extract(entry, folder + "/array.npy");
            out.push_back(std::make_unique<NpyRecording>(folder + "/array.npy", path,
                                                         entry.name.substr(0, entry.name.size() - 4)));
            fs::remove(folder + "/array.npy");
        }
    } catch (const FileError&) {
        throw;
    } catch (const std::exception& e) {
        no_recording(path, e.what());
    }
    return out;
}

}  // namespace

bool is_recording(const std::string& path) {
    const auto extension = final_name(path).extension();
    return extension == ".csv" || extension == ".npy" || extension == ".npz" || extension == ".h5";
}

std::vector<std::unique_ptr<Recording>> open_recording(const std::string& path) {
    const auto extension = final_name(path).extension();
    std::vector<std::unique_ptr<Recording>> out;
    if (extension == ".h5") return open_hdf5_recording(path);
    if (extension == ".npz") return open_npz(path);
    if (extension == ".npy")
        out.push_back(std::make_unique<NpyRecording>(path, path, final_name(path).stem().string()));
    else if (extension == ".csv")
        out.push_back(std::make_unique<CsvRecording>(path));
    else
        no_recording(path, "its name ends in none of .csv, .npy, .npz and .h5");
    return out;
}

}  // namespace forage::observe

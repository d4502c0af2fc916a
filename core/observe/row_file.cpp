#include "core/observe/row_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "core/observe/hdf5_file.h"
#include "core/observe/npy_file.h"
#include "core/observe/text_files.h"

namespace forage::observe {

std::unique_ptr<RowFile> open_row_file(RecordingFormat format, const std::string& path,
                                       const RowFileHeader& header,
                                       const std::optional<RowFilePosition>& go_on) {
    switch (format) {
        case RecordingFormat::csv:
            return std::make_unique<CsvFile>(path, header.sources.at(0), go_on);
        case RecordingFormat::npy:
            return std::make_unique<NpyFile>(path, header.sources.at(0), go_on);
        case RecordingFormat::sampler:
            return std::make_unique<SamplerFile>(path, header, go_on);
        case RecordingFormat::hdf5:
            break;
    }
    return open_hdf5_file(path, header, go_on);
}

BlockFile::BlockFile(std::string path, std::optional<std::uint64_t> go_on) : path_(std::move(path)) {
    std::error_code error;
    if (go_on) {
        const auto size = std::filesystem::file_size(path_, error);
        if (!error && size < *go_on)
            throw ShortFile(
                fmt::format("'{}' has {} bytes, and should have {} at least", path_, size, *go_on));
        if (!error) std::filesystem::resize_file(path_, *go_on, error);
        if (error) throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, error.message()));
        written_ = *go_on;
        out_.open(path_, std::ios::binary | std::ios::in | std::ios::out | std::ios::ate);
    } else {
        out_.open(path_, std::ios::binary | std::ios::out | std::ios::trunc);
    }
    if (!out_) throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
}

void BlockFile::flush(std::string_view head) {
    if (!open()) return;
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    out_.flush();  // the rows are written before the head counts them
    if (!out_) fail();
    if (!head.empty()) {
        out_.seekp(0);
        out_.write(head.data(), static_cast<std::streamsize>(head.size()));
        out_.seekp(0, std::ios::end);
        out_.flush();
        if (!out_) fail();
    }
    written_ += buffer_.size();
    buffer_.clear();
}

void BlockFile::close() {
    if (!open()) return;  // it failed before
    out_.close();
    if (!out_) fail();
}

void BlockFile::fail() {
    const std::string reason = std::strerror(errno);
    out_.close();
    std::error_code ignored;
    std::filesystem::resize_file(path_, written_, ignored);  // a part of a row may have been written
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, reason));
}

}  // namespace forage::observe

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
                                       const RowFileHeader& header) {
    switch (format) {
        case RecordingFormat::csv:
            return std::make_unique<CsvFile>(path, header.sources.at(0));
        case RecordingFormat::npy:
            return std::make_unique<NpyFile>(path, header.sources.at(0));
        case RecordingFormat::sampler:
            return std::make_unique<SamplerFile>(path, header);
        case RecordingFormat::hdf5:
            break;
    }
    return open_hdf5_file(path, header);
}

BlockFile::BlockFile(std::string path) : path_(std::move(path)) {
    out_.open(path_, std::ios::binary | std::ios::out | std::ios::trunc);
    if (!out_) throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
}

void BlockFile::flush(std::string_view head) {
    if (!open()) return;
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    out_.flush();  // the rows are there before the head counts them
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
    std::filesystem::resize_file(path_, written_, ignored);  // half a row may have gone out
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, reason));
}

}  // namespace forage::observe

#include "core/observe/npy_file.h"

#include <bit>

#include <fmt/format.h>

namespace forage::observe {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

std::string npy_head(const std::string& type, std::uint64_t rows) {
    const std::string count = fmt::format("({},)", rows);
    std::string text = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': {}{:{}}, }}", type, count,
                                   "", std::max<int>(0, 24 - static_cast<int>(count.size())));
    const std::size_t length = (10 + text.size() + 1 + 63) / 64 * 64;
    text.resize(length - 10 - 1, ' ');
    text += '\n';
    if (length > 65535) throw std::runtime_error("the names of the columns are too long for a .npy file");
    std::string out("\x93NUMPY\x01\x00", 8);
    out += static_cast<char>(text.size() & 0xFF);
    out += static_cast<char>(text.size() >> 8);
    return out + text;
}

NpyFile::NpyFile(const std::string& path, const Recorded& what, const std::optional<RowFilePosition>& go_on)
    : rows_(go_on ? go_on->rows : 0), file_(path, go_on ? std::optional(go_on->bytes) : std::nullopt) {
    const std::string field = what.state.empty() ? "value" : what.state;
    type_ = what.one_number() ? fmt::format("[('cycle', '<u8'), ('{}', '<f8')]", field)
                              : fmt::format("[('cycle', '<u8'), ('{}', '<f8', ({}, {}))]", field,
                                            what.cells.height, what.cells.width);
    if (!go_on) file_.buffer() = npy_head(type_, 0);
}

void NpyFile::add(std::uint64_t cycle, std::span<const double> numbers) {
    std::string& out = file_.buffer();
    out.append(reinterpret_cast<const char*>(&cycle), sizeof cycle);
    out.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
    ++rows_;
    if (file_.full()) flush();
}

}  // namespace forage::observe

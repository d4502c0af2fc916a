#include "core/plugin/elf.h"

#include <cstring>
#include <filesystem>
#include <fstream>

#include <elf.h>
#include <link.h>

namespace forage::plugin {
namespace {

using Header = ElfW(Ehdr);
using Segment = ElfW(Phdr);

bool read_at(std::ifstream& in, std::uint64_t offset, void* to, std::size_t size) {
    in.seekg(static_cast<std::streamoff>(offset));
    in.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
    return static_cast<bool>(in);
}

/// The header of this program's own file.
Header own_header() {
    Header out{};
    std::ifstream in("/proc/self/exe", std::ios::binary);
    read_at(in, 0, &out, sizeof out);
    return out;
}

}  // namespace

std::string why_not_loadable(const std::string& path) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path)) return "is not a file";
    std::ifstream in(path, std::ios::binary);
    Header header{};
    if (error || !in) return "cannot be read";
    if (!read_at(in, 0, &header, sizeof header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
        return "is not a shared object";
    const Header own = own_header();
    if (header.e_ident[EI_CLASS] != own.e_ident[EI_CLASS] ||
        header.e_ident[EI_DATA] != own.e_ident[EI_DATA] || header.e_machine != own.e_machine)
        return "was built for another kind of computer";
    if (header.e_type != ET_DYN) return "is not a shared object";
    for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
        Segment segment{};
        if (!read_at(in, header.e_phoff + i * header.e_phentsize, &segment, sizeof segment) ||
            segment.p_offset > size || segment.p_filesz > size - segment.p_offset)
            return "is cut off: a part of the file is missing";
    }
    return {};
}

}  // namespace forage::plugin

#include "bug_interface/world/plain_png.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>

#include <png.h>

#include "bug_interface/world/png_limits.h"

namespace forage::bug {
namespace {

constexpr std::uint32_t opaque = 0xff000000u;

std::uint32_t pixel(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
    return opaque | blue << 16 | green << 8 | red;
}

/// What a row is made of, and what its bytes stand for.
struct Rows {
    int pixels_per_byte = 0;            ///< 0: three bytes per pixel
    std::vector<std::uint32_t> colour;  ///< of the pixels of a byte, [byte][pixel]
    std::vector<std::uint8_t> bytes;    ///< of one row, and one more
};

template <int pixels_per_byte>
void look_up(const Rows& rows, int width, std::uint32_t* out) {
    const std::uint8_t* bytes = rows.bytes.data();
    const std::uint32_t* colour = rows.colour.data();
    const int whole = width / pixels_per_byte, rest = width % pixels_per_byte;
    for (int i = 0; i < whole; ++i)
        std::memcpy(out + i * pixels_per_byte, colour + bytes[i] * pixels_per_byte,
                    pixels_per_byte * sizeof *out);
    if (rest > 0) std::copy_n(colour + bytes[whole] * pixels_per_byte, rest, out + whole * pixels_per_byte);
}

void expand(const Rows& rows, int width, std::uint32_t* out) {
    switch (rows.pixels_per_byte) {
        case 1:
            return look_up<1>(rows, width, out);
        case 2:
            return look_up<2>(rows, width, out);
        case 4:
            return look_up<4>(rows, width, out);
        case 8:
            return look_up<8>(rows, width, out);
        default:
            break;
    }
    const std::uint8_t* bytes = rows.bytes.data();
    for (int i = 0; i < width; ++i, bytes += 3) {
        std::uint32_t four;  // the fourth is of the next pixel
        std::memcpy(&four, bytes, sizeof four);
        out[i] = four | opaque;
    }
}

/// Colours of all bytes, of a palette or of grey; a palette's missing ones are black.
void list_colours(png_structp png, png_infop info, Rows& rows) {
    const int bits = png_get_bit_depth(png, info), values = 1 << bits;
    png_colorp palette = nullptr;
    int count = 0;
    const bool mapped = png_get_PLTE(png, info, &palette, &count) != 0 &&
                        png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE;
    rows.pixels_per_byte = 8 / bits;
    rows.colour.clear();
    for (int byte = 0; byte < 256; ++byte)
        for (int shift = 8 - bits; shift >= 0; shift -= bits) {
            const int value = byte >> shift & (values - 1);
            const auto level = static_cast<std::uint32_t>(value * 255 / (values - 1));
            if (!mapped)
                rows.colour.push_back(pixel(level, level, level));
            else if (value < count)
                rows.colour.push_back(pixel(palette[value].red, palette[value].green, palette[value].blue));
            else
                rows.colour.push_back(pixel(0, 0, 0));
        }
}

constexpr png_byte of_brightness[] = "gAMA\0iCCP";

/// Leaves out all chunks that say nothing of pixels: texts need not be unpacked. Of those that tell what
/// brightness numbers mean, what is in the file is asked for, as libpng forgets it when another such chunk is
/// wrong, and still heeds it in its general reader.
void choose_chunks(png_structp png) {
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, of_brightness, 2);
}

/// No profile, and no gamma but that of sRGB.
bool as_srgb(png_structp png, png_infop info) {
    constexpr png_byte gamma[] = {0, 0, 0xb1, 0x8f};  // 45455
    png_unknown_chunkp chunk = nullptr;
    for (int left = png_get_unknown_chunks(png, info, &chunk); left > 0; --left, ++chunk)
        if (std::memcmp(chunk->name, "gAMA", 4) != 0 || chunk->size != sizeof gamma ||
            std::memcmp(chunk->data, gamma, sizeof gamma) != 0)
            return false;
    return true;
}

bool plain(png_structp png, png_infop info) {
    const int type = png_get_color_type(png, info);
    return png_get_bit_depth(png, info) <= 8 && png_get_interlace_type(png, info) == PNG_INTERLACE_NONE &&
           (type == PNG_COLOR_TYPE_RGB || type == PNG_COLOR_TYPE_PALETTE || type == PNG_COLOR_TYPE_GRAY) &&
           png_get_valid(png, info, PNG_INFO_tRNS) == 0 && as_srgb(png, info) &&
           std::uint64_t{png_get_image_width(png, info)} * png_get_image_height(png, info) <= most_pixels;
}

/// What libpng knows of a file; null when there is no memory for it.
struct PlainReader {
    png_structp png = png_create_read_struct(
        PNG_LIBPNG_VER_STRING, nullptr, [](png_structp failed, png_const_charp) { png_longjmp(failed, 1); },
        [](png_structp, png_const_charp) {});
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    PlainReader() = default;
    ~PlainReader() { png_destroy_read_struct(&png, &info, nullptr); }
    PlainReader(const PlainReader&) = delete;
    PlainReader& operator=(const PlainReader&) = delete;
};

/// libpng leaves this function by a jump when something is wrong: nothing in it has a destructor.
bool read_rows(png_structp png, png_infop info, std::FILE* file, Image& image, Rows& rows) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, file);
    choose_chunks(png);
    png_read_info(png, info);
    if (!plain(png, info)) return false;
    image.width = static_cast<int>(png_get_image_width(png, info));
    image.height = static_cast<int>(png_get_image_height(png, info));
    image.pixels.resize(image.stride() * static_cast<std::size_t>(image.height + 2 * image.border));
    rows.bytes.resize(png_get_rowbytes(png, info) + 1);
    if (png_get_color_type(png, info) != PNG_COLOR_TYPE_RGB) list_colours(png, info, rows);
    for (int r = 0; r < image.height; ++r) {
        png_read_row(png, rows.bytes.data(), nullptr);
        expand(rows, image.width, image.row(r));
    }
    return true;
}

}  // namespace

bool read_plain_png(const std::string& path, Image& image) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) return false;
    const PlainReader reader;
    Rows rows;
    return reader.info && read_rows(reader.png, reader.info, file.get(), image, rows);
}

}  // namespace forage::bug

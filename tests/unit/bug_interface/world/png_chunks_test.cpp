// Chunks before the pixels of a picture: the meaning of colours, and too much data.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include <malloc.h>
#include <unistd.h>

#include "bug_interface/world/png.h"
#include "tests/support/catch.h"
#include "tests/support/png_bytes.h"

using namespace forage::bug;
using namespace forage::test;

namespace {

/// A file that exists as long as this object.
class File {
  public:
    File() = default;
    explicit File(const std::string& bytes) { write(bytes); }
    ~File() { std::filesystem::remove(path_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
    operator const std::string&() const { return path_; }

  private:
    std::string path_ =
        std::filesystem::temp_directory_path() / ("forage_png_chunks_" + std::to_string(getpid()) + ".png");
};

const std::string grey_rows("\0\x40\x80", 3), rgb_rows("\0\x40\x80\xc0\x10\x20\x30", 7),
    palette_rows("\0\1\0", 3), palette = png_chunk("PLTE", "\1\2\3\x40\x80\xc0");

std::vector<std::uint32_t> pixels(Image& image) { return {image.row(0), image.row(0) + image.width}; }

}  // namespace

TEST_CASE("Chunks without new information about colours do not change them") {
    std::string srgb_white_and_primaries;
    for (const std::uint32_t v : {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000})
        srgb_white_and_primaries += big_endian(v);
    const std::string chunk =
        GENERATE_COPY(std::string(), png_chunk("sRGB", std::string(1, '\0')),
                      png_chunk("sRGB", "\4"),  // there is no such intent
                      png_chunk("gAMA", big_endian(45455)), png_chunk("gAMA", "\1\2"),
                      png_chunk("cHRM", srgb_white_and_primaries), png_chunk("cHRM", std::string(32, '\0')),
                      png_chunk("iCCP", "name" + std::string(2, '\0') + "rubbish"),
                      png_chunk("tEXt", "Title" + std::string(1, '\0') + "Floor"));
    INFO(chunk.substr(std::min<std::size_t>(4, chunk.size()), 4));
    const auto read = [](const std::string& bytes) {
        const File file(bytes);
        Image image = read_png(file, 0);
        return pixels(image);
    };
    using Colours = std::vector<std::uint32_t>;
    CHECK(read(png_file(2, 1, PngColour::grey, chunk, grey_rows)) == Colours{0xff404040, 0xff808080});
    CHECK(read(png_file(2, 1, PngColour::rgb, chunk, rgb_rows)) == Colours{0xffc08040, 0xff302010});
    CHECK(read(png_file(2, 1, PngColour::palette, chunk + palette, palette_rows)) ==
          Colours{0xffc08040, 0xff030201});
}

TEST_CASE("A gamma is respected even if libpng finds the colour space wrong") {
    const std::string linear = png_chunk("gAMA", big_endian(100'000));
    const std::vector<std::uint32_t> lighter{0xff888888, 0xffbababa};  // as without the wrong chunk
    for (const std::string& with :
         {std::string(), png_chunk("cHRM", std::string(32, '\0')), linear, png_chunk("sRGB", "\4")}) {
        const File file(png_file(2, 1, PngColour::grey, linear + with, grey_rows));
        Image image = read_png(file, 0);
        CHECK(pixels(image) == lighter);
    }
}

TEST_CASE("A picture with too much data before its pixels is refused before the data are read") {
    const auto colour = GENERATE(PngColour::rgb, PngColour::rgb_alpha);
    const auto with = [&](std::size_t bytes, const char* name) {
        const std::string text = png_chunk(name, "Title" + std::string(2, '\0') + std::string(bytes, 'x'));
        return png_file(2, 1, colour, text, std::string(colour == PngColour::rgb ? 7 : 9, '\0'));
    };
    const std::string refused =
        "more than 64 KiB of texts, profiles and the like precede its pixels; save it without them";
    const auto* name = GENERATE("tEXt", "zTXt", "iTXt", "iCCP", "sPLT");
    const File small(with(1000, name));
    CHECK(png_problem(small) == "");
    CHECK(read_png(small, 0).width == 2);
    const File large(with(200'000, name));
    CHECK(png_problem(large) == refused);
    CHECK_THROWS_WITH(read_png(large, 0), ContainsSubstring(refused));
}

TEST_CASE("Many small chunks before the pixels count like one large chunk; chunks of pixels do not count") {
    std::string many, pixels_of_many;
    for (int i = 0; i < 12'000; ++i) many += png_chunk("tEXt", ""), pixels_of_many += png_chunk("IDAT", "");
    const File before(png_file(2, 1, PngColour::rgb_alpha, many, std::string(9, '\0')));
    CHECK_THAT(png_problem(before), ContainsSubstring("precede its pixels"));
    const File within(png_file(2, 1, PngColour::rgb_alpha, pixels_of_many, std::string(9, '\0')));
    CHECK(png_problem(within) == "");
    const File none("\x89PNG\r\n\x1a\n" + many);
    CHECK_THAT(png_problem(none), ContainsSubstring("precede its pixels"));
    const File text(std::string(1'000'000, 'x'));
    CHECK(png_problem(text) == "Not a PNG file");
    const File cut("\x89PNG\r\n\x1a\n\x7f\xff\xff\xff");
    CHECK(png_problem(cut) == "Read Error");
}

TEST_CASE("A picture that is too large is not read") {
    const std::string problem = "it has 16781312 pixels; the most are 16777216";
    const auto colour = GENERATE(PngColour::rgb, PngColour::rgb_alpha);
    const File file(png_file(4096, 4097, colour, "", rgb_rows));
    CHECK(png_problem(file) == problem);
    CHECK_THROWS_WITH(read_png(file, 0), ContainsSubstring(problem));
}

TEST_CASE("A picture that does not fit into memory is refused and leaves nothing behind") {
    const auto colour = GENERATE(PngColour::rgb, PngColour::rgb_alpha);
    const File file(png_file(1, 1, colour, "", std::string(5, '\0')));
    constexpr int border = (1 << 30) - 100;  // more numbers than a vector may have
    const auto fail = [&] { CHECK_THROWS_AS(read_png(file, border), std::length_error); };
    fail();
    const auto before =
        mallinfo2().uordblks;  // 0 with the address sanitizer, which searches for leaks itself
    for (int i = 0; i < 100; ++i) fail();
    CHECK(mallinfo2().uordblks < before + 10'000);
}

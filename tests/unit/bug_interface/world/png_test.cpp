#include "bug_interface/world/png.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <sys/stat.h>

#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage::bug;

TEST_CASE("A file that is not a picture is reported before its pixels are read") {
    const auto folder = forage::test::temporary_path("forage_floor_picture");
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const std::string good = folder / "good.png", cut = folder / "cut.png", pipe = folder / "pipe.png";
    std::ofstream(good, std::ios::binary) << encode_png(20, 10, std::vector<std::uint8_t>(600, 100));
    CHECK(png_problem(good) == "");
    CHECK(read_png(good, 0).width == 20);

    std::filesystem::copy_file(good, cut);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) - 5);
    CHECK(png_problem(cut) == "its end is missing");

    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(png_problem(pipe) == "it is not a file");  // and does not wait for a writer
    CHECK(png_problem(folder) == "it is not a file");
    CHECK(png_problem(folder / "none.png") == "it is not a file");
    std::filesystem::remove_all(folder);
}

namespace {

/// The picture in a PNG file of these bytes, written as hexadecimal numbers.
Image picture(const std::string& hex, int border) {
    const auto path = forage::test::temporary_path("forage_floor_picture.png");
    std::string bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    std::ofstream(path, std::ios::binary) << bytes;
    Image image = read_png(path, border);
    std::filesystem::remove(path);
    return image;
}

}  // namespace

TEST_CASE("Pictures of all kinds become red, green and blue; transparent pixels are drawn on black") {
    using Colours = std::vector<std::uint32_t>;
    const auto pixels = [](const Image& image) { return Colours(image.pixels.begin(), image.pixels.end()); };
    const std::string coloured =  // red, and green that cannot be seen
        "89504e470d0a1a0a0000000d4948445200000002000000010806000000f4227f8a0000000f4944415478da63f8"
        "cfc0f01f0819000ff902fe943c3db30000000049454e44ae426082";
    CHECK(pixels(picture(coloured, 0)) == Colours{0xff0000ff, 0xff000000});
    const std::string grey =
        "89504e470d0a1a0a0000000d4948445200000002000000010800000000d14920560000000b4944415478da63e0"
        "3a010000df00d3d885d2ae0000000049454e44ae426082";
    CHECK(pixels(picture(grey, 0)) == Colours{0xff0a0a0a, 0xffc8c8c8});
    const std::string palette =
        "89504e470d0a1a0a0000000d4948445200000002000000010803000000c3fc8fb800000006504c544501020328"
        "323cf20fa94a0000000b4944415478da63606400000005000242c2449f0000000049454e44ae426082";
    CHECK(pixels(picture(palette, 0)) == Colours{0xff3c3228, 0xff030201});
    const std::string transparent =
        "89504e470d0a1a0a0000000d4948445200000002000000010803000000c3fc8fb800000006504c544501020328"
        "323cf20fa94a0000000274524e5300ff5b9122b50000000b4944415478da63606400000005000242c2449f0000"
        "000049454e44ae426082";
    CHECK(pixels(picture(transparent, 0)) == Colours{0xff3c3228, 0xff000000});
}

TEST_CASE("Pixels of any size and rows of any kind are read, and the brightness in the file is respected") {
    using Colours = std::vector<std::uint32_t>;
    const auto pixels = [](const Image& image) { return Colours(image.pixels.begin(), image.pixels.end()); };
    const std::string four_bits =  // three pixels of 4 bits; there is no colour 9 in the palette
        "89504e470d0a1a0a0000000d4948445200000003000000010403000000e9ce098700000009504c5445010203"
        "28323c070809d97cefee0000000b4944415478da63109a000000b700a3bdd82d8b0000000049454e44ae4260"
        "82";
    CHECK(pixels(picture(four_bits, 0)) == Colours{0xff3c3228, 0xff090807, 0xff000000});
    const std::string two_bits =  // five pixels of 2 bits, grey
        "89504e470d0a1a0a0000000d49484452000000050000000102000000007925238e0000000b4944415478da63"
        "907600000079005c9cd030f50000000049454e44ae426082";
    CHECK(pixels(picture(two_bits, 0)) ==
          Colours{0xff000000, 0xff555555, 0xffaaaaaa, 0xffffffff, 0xff555555});
    const std::string one_bit =  // nine pixels of 1 bit
        "89504e470d0a1a0a0000000d4948445200000009000000010103000000360c163e00000009504c5445010203"
        "28323c070809d97cefee0000000b4944415478da6358d0000001c301215632aa400000000049454e44ae4260"
        "82";
    CHECK(pixels(picture(one_bit, 0)) == Colours{0xff3c3228, 0xff030201, 0xff3c3228, 0xff030201, 0xff030201,
                                                 0xff030201, 0xff030201, 0xff030201, 0xff3c3228});
    const std::string differences =  // two rows, as differences to the one above
        "89504e470d0a1a0a0000000d4948445200000002000000020802000000fdd49a73000000114944415478da63"
        "62646266616563825000013b002f415415240000000049454e44ae426082";
    CHECK(pixels(picture(differences, 0)) == Colours{0xff030201, 0xff060504, 0xff060402, 0xff0c0a08});
    const std::string linear =  // its numbers are proportional to the light
        "89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b550000000467414d41000186"
        "a031e8965f0000000a4944415478da6368000000820081da45083b0000000049454e44ae426082";
    CHECK(pixels(picture(linear, 0)) == Colours{0xffbababa});
    const std::string deep =  // 16 bits
        "89504e470d0a1a0a0000000d49484452000000010000000110000000006aee47160000000b4944415478da63"
        "6810020001150093e75a6dde0000000049454e44ae426082";
    CHECK(pixels(picture(deep, 0)) == Colours{0xffbababa});
    const std::string interlaced =  // interlaced
        "89504e470d0a1a0a0000000d4948445200000001000000010802000001e77063480000000c4944415478da63"
        "e0e4600700003600195048f9860000000049454e44ae426082";
    CHECK(pixels(picture(interlaced, 0)) == Colours{0xff070809});
}

TEST_CASE("Mistakes in a picture are reported in the words of libpng") {
    const std::string filter =  // there is no filter 7
        "89504e470d0a1a0a0000000d49484452000000020000000108020000007b40e8dd0000000b4944415478da63"
        "67000300003800087d0cc8030000000049454e44ae426082";
    CHECK_THROWS_WITH(picture(filter, 0), ContainsSubstring("bad adaptive filter value"));
    const std::string checksum =  // of the pixels
        "89504e470d0a1a0a0000000d49484452000000020000000108020000007b40e8dd0000000b4944415478da63"
        "60000300000700012122db160000000049454e44ae426082";
    CHECK_THROWS_WITH(picture(checksum, 0), ContainsSubstring("IDAT: CRC error"));
    const std::string palette =  // is missing
        "89504e470d0a1a0a0000000d4948445200000002000000010803000000c3fc8fb80000000b4944415478da63"
        "60600000000300012b094d840000000049454e44ae426082";
    CHECK_THROWS_WITH(picture(palette, 0), ContainsSubstring("IDAT: Missing PLTE before IDAT"));
    const std::string cut =  // in the pixels
        "89504e470d0a1a0a0000000d49484452000000090000000908020000006ff39147000000274944415478da63"
        "6060646266616563e7e0e4e2e6e1e5e3171014121611";
    CHECK_THROWS_WITH(picture(cut, 0), ContainsSubstring("Read Error"));
}

TEST_CASE("The border of a picture repeats its outermost pixels") {
    const std::string column =
        "89504e470d0a1a0a0000000d494844520000000100000002080200000016e32170000000104944415478da63e0"
        "e46067606365010000ba00289aa5ce910000000049454e44ae426082";
    const Image image = picture(column, 2);
    CHECK(image.width == 1);
    CHECK(image.height == 2);
    REQUIRE(image.pixels.size() == 5 * 6);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        CHECK(image.pixels[i] == (i < 15 ? 0xff070809 : 0xff040506));
}

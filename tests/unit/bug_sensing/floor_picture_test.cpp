#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <sys/stat.h>

#include "bug_interface/world/png.h"
#include "tests/support/catch.h"

using namespace forage::bug;

TEST_CASE("What is no picture is told before it is read") {
    const auto folder = std::filesystem::temp_directory_path() / "forage_floor_picture";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const std::string good = folder / "good.png", cut = folder / "cut.png", pipe = folder / "pipe.png";
    write_png(good, 20, 10, std::vector<std::uint8_t>(600, 100));
    CHECK(png_problem(good) == "");
    CHECK(read_png(good, 0).width == 20);

    std::filesystem::copy_file(good, cut);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) - 5);
    CHECK(png_problem(cut) == "its end is missing");

    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(png_problem(pipe) == "it is no file");  // and does not wait for one who writes
    CHECK(png_problem(folder) == "it is no file");
    CHECK(png_problem(folder / "none.png") == "it is no file");
    std::filesystem::remove_all(folder);
}

namespace {

/// The picture in a PNG file of these bytes, written as hexadecimal numbers.
Image picture(const std::string& hex, int border) {
    const auto path = std::filesystem::temp_directory_path() / "forage_floor_picture.png";
    std::string bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    std::ofstream(path, std::ios::binary) << bytes;
    Image image = read_png(path, border);
    std::filesystem::remove(path);
    return image;
}

}  // namespace

TEST_CASE("Pictures of all kinds become red, green and blue; what is transparent stands before black") {
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

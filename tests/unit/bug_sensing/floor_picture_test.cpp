#include <filesystem>
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
    CHECK(read_png(good).width == 20);

    std::filesystem::copy_file(good, cut);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) - 5);
    CHECK(png_problem(cut) == "its end is missing");

    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(png_problem(pipe) == "it is no file");  // and does not wait for one who writes
    CHECK(png_problem(folder) == "it is no file");
    CHECK(png_problem(folder / "none.png") == "it is no file");
    std::filesystem::remove_all(folder);
}

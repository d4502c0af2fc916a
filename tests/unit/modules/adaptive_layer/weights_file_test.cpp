#include "modules/adaptive_layer/weights_file.h"

#include <filesystem>
#include <fstream>
#include <random>

#include "tests/support/catch.h"
#include "tests/support/golden.h"

using namespace forage::adaptive;
using Eigen::MatrixXd;

namespace {

struct File {
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("forage_weights_" + std::to_string(std::random_device{}()));
    std::string path = (folder / "weights").string();
    File() { std::filesystem::create_directories(folder); }
    explicit File(const std::string& text) : File() { std::ofstream(path) << text; }
    ~File() { std::filesystem::remove_all(folder); }
};

std::string complaint(const std::string& text) {
    const File file(text);
    try {
        read_weights(file.path, 2, 2);
    } catch (const std::exception& e) {
        return std::string(e.what()).replace(std::string(e.what()).find(file.path), file.path.size(), "FILE");
    }
    return "none";
}

MatrixXd two_by_two(double a, double b, double c, double d) {
    return (MatrixXd(2, 2) << a, b, c, d).finished();
}

}  // namespace

TEST_CASE("Weights are written one line per response, with six digits and a comma after each number") {
    const File file;
    MatrixXd w(3, 2);
    w << 0.5, -1, 1.0 / 3, 1e-7, 12345678, 0;
    write_weights(file.path, w);
    CHECK(forage::test::read_text(file.path) == "0.5, 0.333333, 1.23457e+07, \n-1, 1e-07, 0, \n");
}

TEST_CASE("Weights are read as they were written, to six digits") {
    const File file;
    const MatrixXd w = MatrixXd::Random(5, 3);
    write_weights(file.path, w);
    const MatrixXd again = read_weights(file.path, 5, 3);
    CHECK((again - w).cwiseAbs().maxCoeff() < 1e-6);
    write_weights(file.path, again);
    CHECK(read_weights(file.path, 5, 3) == again);
}

TEST_CASE("Weights replace weights, and no other file") {
    const MatrixXd w = MatrixXd::Ones(2, 2);
    for (const char* text : {"", "1, 2, \n3, nan, \n"}) {
        const File file(text);
        write_weights(file.path, w);
        CHECK(read_weights(file.path, 2, 2) == w);
    }
    const File file("export PATH=/bin\n"), other;
    CHECK_THROWS_WITH(write_weights(file.path, w), ContainsSubstring("holds something else"));
    std::filesystem::create_symlink(file.path, other.path);
    CHECK_THROWS_WITH(write_weights(other.path, w), ContainsSubstring("holds something else"));
    std::filesystem::remove(other.path);
    std::filesystem::create_symlink(file.path, other.path + ".part");
    write_weights(other.path, w);
    CHECK(forage::test::read_text(file.path) == "export PATH=/bin\n");
    CHECK(read_weights(other.path, 2, 2) == w);
}

TEST_CASE("White space between weights is ignored, and the last comma may be missing") {
    const MatrixXd expected = two_by_two(1, 3, 2, 4);
    for (const char* text : {"1,2,3,4", "1, 2, \n3, 4, \n", " 1\n,\n\n2 ,\t3,4,\r\n", "+1,2.0,3e0,4,"})
        CHECK(read_weights(File(text).path, 2, 2) == expected);
}

TEST_CASE("A file without valid weights is rejected, with the location and the reason") {
    CHECK_THAT(complaint("1, 2, 3"), ContainsSubstring("FILE:1:8: 3 weights") && ContainsSubstring("need 4"));
    CHECK_THAT(complaint("1, 2, \n3, 4, \n5, "),
               ContainsSubstring("5 weights") && ContainsSubstring("need 4"));
    CHECK_THAT(complaint("1, 2, \n3, 8x, \n"), ContainsSubstring("FILE:2:4: '8x' is not a number"));
    CHECK_THAT(complaint("1, 2 \n3, 4, \n"), ContainsSubstring("FILE:1:4: '2 ?3' is not a number"));
    CHECK_THAT(complaint("1, , 3, 4"), ContainsSubstring("there is no number here"));
    CHECK_THAT(complaint("1, nan, 3, 4"), ContainsSubstring("'nan'"));
    CHECK_THAT(complaint("1, 1e300, 3, 4"), ContainsSubstring("'1e300'"));
    CHECK_THAT(complaint(""), ContainsSubstring("0 weights"));
    CHECK_THAT(complaint("\x1b[31m"),
               ContainsSubstring("these are not weights: no row begins with a number"));
    CHECK_THAT(complaint("1, 2, \x1b[31m"), ContainsSubstring("'?[31m'"));
    CHECK_THAT(complaint("1, x, 3, \n4y, z"),
               ContainsSubstring("FILE:1:4: 'x'") && ContainsSubstring("and 2 more errors"));
}

TEST_CASE("A missing file and a folder are rejected by name") {
    const File file;
    CHECK_THROWS_WITH(read_weights(file.path, 2, 2),
                      ContainsSubstring("no such file") && ContainsSubstring(file.path));
    CHECK_THROWS_WITH(read_weights(file.folder.string(), 2, 2), ContainsSubstring("a directory"));
}

TEST_CASE("No file remains when weights cannot be written") {
    const File file;
    CHECK_THROWS_WITH(write_weights((file.folder / "none" / "weights").string(), MatrixXd::Zero(2, 2)),
                      ContainsSubstring("cannot write"));
    CHECK_THROWS_WITH(write_weights(file.folder.string(), MatrixXd::Zero(2, 2)),
                      ContainsSubstring("cannot write"));
    CHECK(std::filesystem::is_empty(file.folder));
    CHECK_FALSE(std::filesystem::exists(file.folder.string() + ".part"));
}

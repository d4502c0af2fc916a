#include "core/base/array.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/text_file.h"
#include "tests/support/catch.h"

using namespace forage;
using Form = Array::Form;

namespace {

struct ArrayFile {
    std::string path;
    ArrayFile(const std::string& name, const std::string& bytes)
        : path((std::filesystem::temp_directory_path() / fmt::format("forage_{}_{}", ::getpid(), name))
                   .string()) {
        std::ofstream(path, std::ios::binary) << bytes;
    }
    ~ArrayFile() { std::filesystem::remove(path); }
};

template <class T>
std::string npy(const std::string& type, const std::string& shape, const std::vector<T>& values,
                const char* by_column = "False") {
    std::string head =
        fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}", type, by_column, shape);
    head.resize(117, ' ');
    head += '\n';
    std::string out("\x93NUMPY\x01\x00\x76\x00", 10);
    out += head;
    return out + std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// "rows x columns: numbers", or the faults with their places.
std::string shown(const Array& a) {
    std::string out;
    for (const auto& f : a.faults())
        out += fmt::format("{}:{} {}; ", f.where.line, f.where.column, f.message);
    if (!a.faults().empty()) return out;
    out = fmt::format("{} x {}:", a.rows(), a.columns());
    for (const double v : a.numbers()) out += fmt::format(" {}", v);
    return out;
}
std::string shown(const std::string& bytes, Form form = Form::matrix, std::string_view column = {}) {
    const ArrayFile file("array.csv", bytes);
    return shown(*Array::read(file.path, form, column));
}

}  // namespace

TEST_CASE("a CSV file has rows of numbers, and empty fields and nan are left out") {
    CHECK(shown("1,2.5\n-3e-2,4") == "2 x 2: 1 2.5 -0.03 4");
    CHECK(shown("\xEF\xBB\xBF"
                "1, nan\r\n,NaN\r\n# a remark\r\n2,3\r\n") == "3 x 2: 1 nan nan nan 2 3");
    const ArrayFile file("array.csv", "1,nan\n,4\n");
    CHECK(Array::read(file.path, Form::matrix)->left_out() == 2);
}

TEST_CASE("a list may have a heading, and a column is found by its name") {
    CHECK(shown("source,target,weight\n0,1,0.5\n1,0,2\n", Form::list) == "2 x 3: 0 1 0.5 1 0 2");
    CHECK(shown("0,1,0.5,3\n", Form::list) == "1 x 4: 0 1 0.5 3");
    CHECK(shown("cell,kind,u0\n0,RS,-13\n1,FS,-14.5\n", Form::column, "u0") == "2 x 1: -13 -14.5");
}

TEST_CASE("mistakes in a text have a line and a column") {
    CHECK(shown("1,2\n3\n4,x\n") == "2:1 a row of 1 number, not 2; 3:3 'x' is not a number; ");
    CHECK(shown("a,b\n1,2\n") == "1:1 'a' is not a number; ");
    CHECK(shown("1,inf\n") == "1:3 'inf' is not a finite number; ");
    CHECK(shown("") == "0:0 there are no numbers in it; ");
    CHECK(shown("nan,nan\n") == "0:0 there are no numbers in it; ");
    CHECK(shown("1,2\n", Form::list) == "1:1 a row of a list has 3 or 4 numbers, not 2; ");
    CHECK(shown("1,,2\n", Form::list) == "1:3 a number is left out; ");
    CHECK(shown("a,b\n1,2\n", Form::column, "c") == "1:1 there is no column 'c'; ");
}

TEST_CASE("a .npy file may have several types and both orders") {
    CHECK(shown(npy<double>("<f8", "(2, 3)", {1, 2, 3, 4, 5, 6})) == "2 x 3: 1 2 3 4 5 6");
    CHECK(shown(npy<double>("<f8", "(2, 3)", {1, 4, 2, 5, 3, 6}, "True")) == "2 x 3: 1 2 3 4 5 6");
    CHECK(shown(npy<float>("<f4", "(2,)", {0.5f, -1})) == "2 x 1: 0.5 -1");
    CHECK(shown(npy<std::int16_t>("<i2", "(1, 2)", {-7, 8})) == "1 x 2: -7 8");
}

TEST_CASE("of a recording, the last record is read") {
    const std::string type = "[('cycle', '<u8'), ('weight', '<f8', (2, 2))]";
    auto bytes = npy<double>("<f8", "(2,)", {0, 1, 2, 3, 4, 0, 5, 6, NAN, 8});
    bytes.replace(bytes.find("'<f8'"), 5, type).erase(bytes.find("\n") - type.size() + 5, type.size() - 5);
    CHECK(shown(bytes) == "2 x 2: 5 6 nan 8");
    bytes.replace(bytes.find("(2,)"), 4, "(0,)");
    CHECK(shown(bytes) == "0:0 the head of this .npy file is damaged; ");
}

TEST_CASE("a .npy file that does not fit is refused") {
    CHECK(shown(npy<double>("<f8", "(2, 3)", {1, 2})) ==
          "0:0 the file ends early: 2 x 3 numbers take 48 bytes, and there are 16; ");
    CHECK(shown(npy<double>(">f8", "(1, 1)", {1})) == "0:0 this .npy file holds numbers of the type '>f8'; ");
    CHECK(shown(npy<double>("<f8", "(1, 1, 1)", {1})) == "0:0 this .npy file has 3 dimensions; ");
    CHECK(shown(npy<double>("<f8", "(9999999999, 9999999999)", {1})).find("are too many") !=
          std::string::npos);
    CHECK(shown(npy<double>("<f8", "(1, 2)", {1, INFINITY})) ==
          "0:0 the number in row 0, column 1 is infinite; ");
    CHECK(shown(npy<double>("<f8", "(1, 1)", {1}), Form::column, "a") ==
          "0:0 a .npy file has no columns with names; ");
    CHECK(shown(std::string("\x93NUMPY\x01\x00\xff\xff", 10)) ==
          "0:0 the head of this .npy file is damaged; ");
}

TEST_CASE("rows of a text are found at their place in the file") {
    const Location at{std::make_shared<SourceFile>(SourceFile{"a.iqr", {}}), 7, 12};
    const auto good = Array::parse("0 0.5, 1\n1 nan 2\n", Form::matrix, at);
    CHECK(shown(*good) == "2 x 3: 0 0.5 1 1 nan 2");
    CHECK(good->place(1).line == 8);
    CHECK(shown(*Array::parse("0 x\n1 y 2", Form::matrix, at)) ==
          "7:14 'x' is not a number; 8:1 a row of 3 numbers, not 2; 8:3 'y' is not a number; ");
}

TEST_CASE("arrays are equal when they are the same state of a file, or the same numbers") {
    const ArrayFile a("array_a.csv", "1,2\n"), b("array_b.csv", "1,2\n");
    const auto first = Array::read(a.path, Form::matrix);
    CHECK(*first == *Array::read(a.path, Form::matrix));
    CHECK_FALSE(*first == *Array::read(b.path, Form::matrix));
    CHECK(*Array::parse("1 nan", Form::matrix, {}) == *Array::parse("1,nan", Form::matrix, {}));
    CHECK_FALSE(*Array::parse("1 2", Form::matrix, {}) == *Array::parse("1\n2", Form::matrix, {}));
}

TEST_CASE("numbers that stay in the file are copied by rows") {
    const ArrayFile file("array.npy", npy<double>("<f8", "(3, 2)", {1, 2, 3, 4, 5, 6}));
    const auto array = Array::read(file.path, Form::matrix);
    double two[4];
    array->copy(1, 2, two);
    CHECK(two[0] == 3);
    CHECK(two[3] == 6);
    std::filesystem::resize_file(file.path, 140);
    CHECK_THROWS_AS(array->copy(1, 2, two), FileError);
}

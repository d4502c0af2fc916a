#include "core/base/table.h"

#include <filesystem>

#include <unistd.h>

#include "core/base/named_file.h"
#include "tests/support/catch.h"

using namespace forage;
using Layout = TableReader::Layout;

namespace {

/// The rows of a text, with '|' between their fields.
std::vector<std::string> rows(const std::string& text, Layout layout) {
    TableReader in(text, "t", layout, "this is not a table");
    std::vector<std::string> out;
    while (in.next()) {
        out.emplace_back();
        for (const auto& f : in.fields())
            out.back() += (&f == &in.fields().front() ? "" : "|") + std::string(f);
    }
    in.require_sound();
    return out;
}

using Texts = std::vector<std::string>;

struct File {
    std::string path =
        (std::filesystem::temp_directory_path() / ("forage_table_" + std::to_string(::getpid()))).string();
    explicit File(const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
    ~File() { std::filesystem::remove(path); }
};

/// "line:column message" of each fault that `read` finds.
template <class Read>
Texts faults(Read read) {
    Texts out;
    try {
        read();
    } catch (const FileError& e) {
        for (const auto& f : e.errors())
            out.push_back(std::to_string(f.where.line) + ":" + std::to_string(f.where.column) + " " +
                          f.message);
    }
    return out;
}

}  // namespace

TEST_CASE(
    "A row of CSV is a line; blanks around fields, empty lines, comments and a byte order mark do not "
    "count") {
    CHECK(rows("\xEF\xBB\xBF# one\n1, a b ,\t2\r\n\n  \n , \nlast", Layout::csv) ==
          Texts{"1|a b|2", "|", "last"});
    CHECK(rows("1,\"a, b\",\"\"\n\"say \"\"no\"\", \",x\ny\"z,\"open\n", Layout::csv) ==
          Texts{"1|a, b|", "say \"\"no\"\", |x", "y\"z|\"open"});
    CHECK(rows("", Layout::csv).empty());
}

TEST_CASE(
    "A row of blocks has fields between blanks, commas or semicolons, and an empty line is an empty row") {
    CHECK(rows("1  2,;3\n#x\n\n , \n 4 ", Layout::blocks) == Texts{"1|2|3", "", "", "4"});
}

TEST_CASE("A list is one row, whatever its lines are") {
    CHECK(rows("1,\n 2\n,3,\n", Layout::list) == Texts{"1|2|3"});
    CHECK(rows("", Layout::list) == Texts{""});
}

TEST_CASE("All faults are reported at once, each with its line and column") {
    const auto read = [](Layout layout, const std::string& text) {
        TableReader in(text, "t", layout, "this is not a table");
        while (in.next())
            for (const auto f : in.fields()) in.number(f);
        in.require_sound();
    };
    CHECK(faults([&] { read(Layout::csv, "1, x\n\n,nan\n"); }) == Texts{"1:4 'x' is not a number",
                                                                        "3:1 there is no number here",
                                                                        "3:2 'nan' is not a finite number"});
    CHECK(faults([&] { read(Layout::list, "1,\n2, x,\ny"); }) ==
          Texts{"2:4 'x' is not a number", "3:1 'y' is not a number"});
    std::string many;
    for (int i = 0; i < 300; ++i) many += "1,x\n";
    CHECK(faults([&] { read(Layout::csv, many); }).size() == 100);
    CHECK(faults([&] { read(Layout::csv, "\x89PNG"); }) ==
          Texts{"0:0 this is not a table, but a PNG picture"});
    CHECK(faults([&] { read(Layout::csv, std::string("1,\0", 3)); }) ==
          Texts{"1:3 the byte 0x00 does not occur in a text"});
}

TEST_CASE("Nothing of a file without a row of numbers is quoted") {
    const auto said = [](const std::string& text, Layout layout) {
        try {
            TableReader in(text, "t", layout, "this is not a table");
            while (in.next())
                for (const auto& f : in.fields()) in.number(f);
            in.require_sound();
        } catch (const FileError& e) {
            Diagnostics out;
            report(e, out);
            return format(out);
        }
        return std::string();
    };
    const std::string refused = "t: error: this is not a table: no row begins with a number\n";
    for (const auto layout : {Layout::csv, Layout::blocks, Layout::list})
        for (const char* text :
             {"root:x:0:0:secret\nmail:*:8:8:,secret,1,2\n", "machine a login b password 1 2\n",
              "{\"a\": \"secret\"}", "0 5 * * * backup --token secret\n", "export KEY=secret", "-"})
            CHECK(said(text, layout) == refused);
    for (const char* text :
         {"1,2\n3,secret\n", "a,b\n1,secret\n", "# remark\nnan,x\n", "\"1\",x\n", "0x10,x"})
        CHECK(said(text, Layout::csv).find("is not a number") != std::string::npos);
    CHECK(said(" ,\n", Layout::list).find("there is no number here") != std::string::npos);
    CHECK(said("x 0 1\n0 1 0\n", Layout::blocks).find("'x' is not a number") != std::string::npos);
}

TEST_CASE("Columns are found by the names in the first row, and later rows must have as many fields") {
    const File file("a,b\n1,2\n3\n4,5,6\n7,8\n");
    TableReader in(open_file(file.path), file.path);
    REQUIRE(in.read_header());
    const auto b = in.column("b");
    std::vector<double> numbers;
    while (in.next()) numbers.push_back(in.number(in.fields()[b]));
    CHECK(numbers == std::vector<double>{2, 8});
    CHECK(faults([&] { in.require_sound(); }) ==
          Texts{"3:1 1 fields in this row, not 2", "4:1 3 fields in this row, not 2"});
    TableReader again(open_file(file.path), file.path);
    REQUIRE(again.read_header());
    CHECK(faults([&] { again.column("c"); }) == Texts{"1:1 there is no column 'c'"});
}

TEST_CASE("A file is read block by block; an incomplete last line is not a row") {
    std::string text;
    for (int i = 0; i < 50000; ++i) text += std::to_string(i) + "," + std::to_string(2 * i) + "\n";
    const File file(text + "50000,1");
    TableReader in(open_file(file.path), file.path);
    int count = 0;
    bool same = true;
    for (; in.next(); ++count)
        same = same && in.number(in.fields()[0]) == count && in.number(in.fields()[1]) == 2 * count;
    CHECK(count == 50000);
    CHECK(same);
    CHECK_FALSE(in.failed());
    CHECK(faults([&] { in.require_whole(); }) == Texts{"50001:1 the file ends within this row"});
}

TEST_CASE("Rows cannot be read from a folder") {
    CHECK_THROWS_AS(open_file(std::filesystem::temp_directory_path().string()), FileError);
    CHECK_THROWS_AS(open_file("/dev/null"), FileError);
}

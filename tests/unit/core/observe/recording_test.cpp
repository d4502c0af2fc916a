#include "core/observe/recording.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

#include "core/observe/recorder.h"
#include "core/observe/zip_file.h"
#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::observe;
namespace fs = std::filesystem;

namespace {

/// Two groups of counters; the number of a cell is that of the cycle, from 1.
model::System counters() {
    model::System s;
    s.name = "counters";
    const auto p = model::add_process(s, "P");
    model::add_group(s, p, "A", 3, 2, "counter");
    model::add_group(s, p, "B", 2, 1, "counter");
    return s;
}

class Directory {
  public:
    Directory() : path_(fs::temp_directory_path() / ("forage_recording_" + std::to_string(::getpid()))) {
        fs::create_directories(path_);
    }
    ~Directory() { fs::remove_all(path_); }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  private:
    fs::path path_;
};

struct Rows {
    std::vector<std::uint64_t> cycles;
    std::vector<std::vector<double>> numbers;
};

Rows rows_of(Recording& recording) {
    Rows out;
    std::uint64_t cycle = 0;
    std::vector<double> row;
    while (recording.next(cycle, row)) out.cycles.push_back(cycle), out.numbers.push_back(row);
    return out;
}

std::string text_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Records `names` over `cycles` cycles.
void record(const std::string& path, RecordingFormat format, const std::vector<std::string>& names,
            Sampling sampling, int cycles, bool close = true) {
    const Registry types = test::registry();
    auto simulation = test::run(counters(), types);
    Diagnostics diagnostics;
    std::vector<Source> sources;
    RowFileHeader header{{}, sampling.every, {{"seed", "1"}}};
    for (const auto& n : names) {
        sources.push_back(*find_source(simulation.layout(), n, "test", diagnostics));
        header.sources.push_back(sources.back().what());
    }
    Recorder recorder(open_row_file(format, path, header), sources, sampling);
    for (int c = 0; c < cycles; ++c) simulation.step(), recorder.record(simulation);
    if (close) recorder.close();
}

}  // namespace

TEST_CASE("A recording in any format is read back as the same numbers") {
    const Directory directory;
    for (const auto& [name, format] : {std::pair{"r.csv", RecordingFormat::csv},
                                       {"r.npy", RecordingFormat::npy},
                                       {"r.h5", RecordingFormat::hdf5}}) {
        INFO(name);
        record(directory / name, format, {"P/A(2..3,1..2)"}, {3, 0, {}, false}, 20000);
        const auto all = open_recording(directory / name);
        REQUIRE(all.size() == 1);
        CHECK(all[0]->what().size() == 4);
        for (const int turn : {1, 2}) {
            INFO(turn);
            const Rows rows = rows_of(*all[0]);
            REQUIRE(rows.cycles.size() == 6667);
            CHECK(rows.cycles.front() == 0);
            CHECK(rows.cycles.back() == 19998);
            bool same = true;
            for (std::size_t i = 0; i < rows.cycles.size(); ++i)
                same = same && rows.numbers[i] == std::vector<double>(4, static_cast<double>(3 * i + 1));
            CHECK(same);
            all[0]->rewind();
        }
    }
}

TEST_CASE("CSV and HDF5 files know their cells, HDF5 files for several sources") {
    const Directory directory;
    record(directory / "r.csv", RecordingFormat::csv, {"P/A(2..3,2)"}, {}, 2);
    const auto csv = open_recording(directory / "r.csv");
    CHECK(csv[0]->what().cell_name(1) == "x3_y2");
    record(directory / "r.h5", RecordingFormat::hdf5, {"P/A(2..3,2)", "mean:P/A", "P/B:act"}, {}, 2);
    const auto all = open_recording(directory / "r.h5");
    REQUIRE(all.size() == 3);
    std::vector<std::string> names;
    for (const auto& r : all) names.push_back(r->what().name);
    std::sort(names.begin(), names.end());
    CHECK(names == std::vector<std::string>{"P/A:act(2..3,2)", "P/B:act", "mean:P/A:act"});
    for (const auto& r : all)
        if (r->what().name == "P/A:act(2..3,2)") CHECK(r->what().cell_name(1) == "x3_y2");
}

TEST_CASE("A sampling has a first and a last cycle, and may average over cycles") {
    const Directory directory;
    const auto read = [&](Sampling sampling) {
        record(directory / "r.csv", RecordingFormat::csv, {"P/B(1,1)"}, sampling, 30);
        return rows_of(*open_recording(directory / "r.csv")[0]);
    };
    CHECK(read({5, 7, 20, false}).cycles == std::vector<std::uint64_t>{7, 12, 17});
    // The counter is cycle + 1; the mean of cycles 7..10 is 9.5. Windows that are not full give no row.
    const Rows means = read({4, 7, 20, true});
    CHECK(means.cycles == std::vector<std::uint64_t>{7, 11, 15});
    CHECK(means.numbers == std::vector<std::vector<double>>{{9.5}, {13.5}, {17.5}});
}

TEST_CASE("The sampler's format is the original's to the byte") {
    const Directory directory;
    record(directory / "r.dat", RecordingFormat::sampler, {"P/B", "mean:P/A", "mean:P/A(1..2,1)", "P/A(3,2)"},
           {2, 1, {}, false}, 5);
    std::istringstream text(text_of(directory / "r.dat"));
    std::string line, b, a;
    std::getline(text, line);
    REQUIRE(line.starts_with("# \"B\"="));
    b = line.substr(6);
    std::getline(text, line);
    REQUIRE(line.starts_with("# \"A\"="));
    a = line.substr(6);
    std::getline(text, line), std::getline(text, line), std::getline(text, line);
    CHECK(line == "cycle;" + b + "_act_0;" + b + "_act_1;" + a + "_act_GroupAverage;" + a +
                      "_act_RangeAverage;" + a + "_act_5;");
    std::getline(text, line);
    CHECK(line == "0;2;2;2;2;2;");
    std::getline(text, line);
    CHECK(line == "2;4;4;4;4;4;");
    CHECK_FALSE(std::getline(text, line));
}

TEST_CASE("A file of a killed run can be read up to its last complete row") {
    const Directory directory;
    record(directory / "r.csv", RecordingFormat::csv, {"P/B"}, {}, 3);
    std::string text = text_of(directory / "r.csv");
    std::ofstream(directory / "r.csv.part") << text.substr(0, text.size() - 2);  // "2,3,3\n" lost its end
    CHECK(rows_of(*open_recording(directory / "r.csv.part")[0]).cycles.size() == 2);
    // Rows that were written but not yet counted do not matter.
    record(directory / "r.npy", RecordingFormat::npy, {"P/B"}, {}, 3);
    std::ofstream(directory / "r.npy", std::ios::app | std::ios::binary) << "half a row";
    CHECK(rows_of(*open_recording(directory / "r.npy")[0]).cycles.size() == 3);
}

TEST_CASE("A NumPy file of other records is refused") {
    const Directory directory;
    const auto opened = [&](const std::string& type, const std::string& shape) {
        std::string head = "{'descr': " + type + ", 'fortran_order': False, 'shape': " + shape + ", }\n";
        std::ofstream out(directory / "r.npy", std::ios::binary);
        out.write("\x93NUMPY\x01\x00", 8);
        out << static_cast<char>(head.size()) << '\0' << head << std::string(48, '\0');
        out.close();
        return open_recording(directory / "r.npy").size();
    };
    CHECK(opened("[('cycle', '<u8'), ('v', '<f8')]", "(3,)") == 1);
    CHECK(opened("[('cycle', '<u8'), ('v', '<f8', (1, 2))]", "(2,)") == 1);
    for (const std::string type :
         {"[('cycle', '<u8'), ('v', '<f8'), ('w', '<f8')]", "[('cycle', '<u8'), ('v', [('x', '<f8')])]",
          "[(('title', 'cycle'), '<u8'), ('v', '<f8')]", "[('cycle', '<u8'), ('v', '|O')]", "'|O'",
          "{'names': ['cycle', 'v'], 'formats': ['<u8', '<f8'], 'offsets': [0, 16], 'itemsize': 32}",
          "[('cycle', '<u8'), ('v', '<f8', (1, 2, 2))]", "[('cycle', '<u8'), ('v', '<f8', (2,))]"}) {
        INFO(type);
        CHECK_THROWS_WITH(opened(type, "(1,)"), EndsWith("its records are not a cycle and numbers"));
    }
    CHECK_THROWS_WITH(opened("[('cycle', '<u8'), ('v', '<f8')]", "(3, 1)"),
                      EndsWith("it does not say how many rows it has"));
}

TEST_CASE("A file that is not a recording is refused by name") {
    const Directory directory;
    for (const auto& [name, text] : {std::pair{"a.csv", "time,x1_y1\n0,1\n"},
                                     {"b.csv", "cycle,x1_y1,x3_y1\n"},
                                     {"c.csv", ""},
                                     {"d.npy", "nothing"},
                                     {"e.h5", "nothing"},
                                     {"f.txt", "cycle,x1_y1\n"}}) {
        std::ofstream(directory / name) << text;
        INFO(name);
        try {
            open_recording(directory / name);
            FAIL("it was read");
        } catch (const std::runtime_error& e) {
            CHECK(std::string(e.what()).find(name) != std::string::npos);
        }
    }
    std::ofstream(directory / "g.csv") << "cycle,x1_y1\n0,1\n1,x\n";
    auto recording = open_recording(directory / "g.csv");
    CHECK_THROWS_WITH(rows_of(*recording[0]), EndsWith("g.csv:3:3: 'x' is not a number"));
}

TEST_CASE(
    "Writing an archive changes no other file, except remains of the same archive from a killed program") {
    const Directory directory;
    const auto write = [&](const std::string& name) { std::ofstream(directory / name) << name; };
    const std::vector<std::string> neighbours = {"a.npz.backup", "a.npz.part.backup", "a.npz.abcdef"};
    for (const auto& name : neighbours) write(name);
    fs::create_directory(directory / "a.npz.part");
    write("a.npz.part/archive.npz.Xy12Zz");
    write("row.npy");

    write_zip(directory / "a.npz", {{"row.npy", directory / "row.npy"}}, false);
    const ZipFile archive(directory / "a.npz");
    archive.extract(archive.entries().front(), directory / "again.npy");
    CHECK(text_of(directory / "again.npy") == "row.npy");
    for (const auto& name : neighbours) CHECK(text_of(directory / name) == name);
    CHECK_FALSE(fs::exists(directory / "a.npz.part"));
    CHECK_THROWS_WITH(write_zip(directory / "none/a.npz", {}, false), ContainsSubstring("cannot write"));
    CHECK_THROWS_WITH(write_zip(directory / "a.npz", {{"row.npy", directory / "none.npy"}}, false),
                      ContainsSubstring("cannot write"));
    CHECK_FALSE(fs::exists(directory / "a.npz.part"));
}

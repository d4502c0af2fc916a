#include "core/base/output_files.h"

#include <filesystem>

#include "core/base/text_file.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;
namespace fs = std::filesystem;

namespace {

/// A folder with a file of the user, "mine", and a link to it.
struct Folder {
    fs::path folder = test::temporary_path("forage-output-files");
    std::string mine = (folder / "mine").string(), link = (folder / "a.csv").string();
    Folder() {
        fs::remove_all(folder), fs::create_directories(folder);
        write_file(mine, "old");
    }
    ~Folder() { fs::remove_all(folder); }
};

}  // namespace

TEST_CASE("A file that is edited keeps its link, a result replaces one") {
    const Folder f;
    fs::create_symlink(f.mine, f.link);
    write_file(f.link, "new");
    CHECK(fs::is_symlink(f.link));
    CHECK(read_file(f.mine) == "new");
    for (const auto write : {+[](const std::string& path) { write_result(path, "result"); },
                             +[](const std::string& path) { write_durably(path, "result"); }}) {
        fs::remove(f.link), fs::create_symlink(f.mine, f.link);
        write(f.link);
        CHECK_FALSE(fs::is_symlink(f.link));
        CHECK(read_file(f.link) == "result");
        CHECK(read_file(f.mine) == "new");
    }
}

TEST_CASE("A link with the temporary name of a file is not followed") {
    const Folder f;
    fs::create_symlink(f.mine, partial(f.link));
    write_result(f.link, "result");
    CHECK(read_file(f.mine) == "old");
    for (const auto& target : {f.mine, f.mine + "-that-is-not-there"}) {
        fs::create_symlink(target, partial(f.link));
        CHECK(remove_unfinished(f.folder.string()) == std::vector<std::string>{"a.csv.part"});
        CHECK_FALSE(fs::is_symlink(partial(f.link)));
    }
    CHECK(read_file(f.mine) == "old");
}

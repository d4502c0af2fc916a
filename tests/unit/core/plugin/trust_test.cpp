#include "core/plugin/trust.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;
namespace fs = std::filesystem;

namespace {

/// A folder with an empty list of trusted folders and a folder "plugins" with a file.
struct Home {
    Home() {
        fs::create_directories(path / "plugins");
        fs::permissions(path, fs::perms::owner_all);
        std::ofstream(file()) << "x";
        for (const auto& p : {path / "plugins", fs::path(file())}) fs::permissions(p, fs::perms::owner_all);
        setenv("XDG_CONFIG_HOME", (path / "config").c_str(), 1);
    }
    ~Home() { fs::remove_all(path); }
    Home(const Home&) = delete;
    std::string folder() const { return (path / "plugins").string(); }
    std::string file() const { return (path / "plugins/a.so").string(); }

    fs::path path = fs::canonical(fs::temp_directory_path()) / ("forage-trust-" + std::to_string(getpid()));
};

Diagnostics trusting(const std::string& folder) {
    Diagnostics out;
    plugin::trust(folder, out);
    return out;
}

}  // namespace

TEST_CASE("A folder is trusted by its canonical name until that is taken back") {
    const Home home;
    CHECK_FALSE(plugin::is_trusted(home.folder()));
    fs::create_directory_symlink(home.folder(), home.path / "link");
    CHECK_FALSE(trusting((home.path / "link/").string()).failed());
    CHECK(plugin::trusted_folders() == std::vector<std::string>{home.folder()});
    CHECK(plugin::is_trusted(home.folder()));
    CHECK(plugin::is_trusted(home.path / "link"));
    CHECK(plugin::is_trusted(home.path / "link/../plugins/."));
    CHECK_FALSE(plugin::is_trusted(home.path));
    CHECK_FALSE(trusting(home.folder()).failed());
    CHECK(plugin::trusted_folders().size() == 1);
    CHECK(fs::status(plugin::trust_list()).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
    Diagnostics diagnostics;
    plugin::distrust(home.folder(), diagnostics);
    CHECK_FALSE(diagnostics.failed());
    CHECK_FALSE(plugin::is_trusted(home.folder()));
    plugin::distrust(home.folder(), diagnostics);
    CHECK(diagnostics.failed());
}

TEST_CASE("A folder that cannot be trusted") {
    const Home home;
    CHECK(trusting((home.path / "nowhere").string()).failed());
    CHECK(trusting(home.file()).failed());
    fs::create_directory(home.path / "a\nb");
    CHECK(trusting((home.path / "a\nb").string()).failed());
    CHECK(plugin::trusted_folders().empty());
}

TEST_CASE("What others may change is not secure") {
    const Home home;
    CHECK_FALSE(plugin::insecure_plugin(home.file()));
    for (const auto& path : {home.folder(), home.file()}) {
        for (const auto bit : {fs::perms::group_write, fs::perms::others_write}) {
            CAPTURE(path, static_cast<int>(bit));
            fs::permissions(path, bit, fs::perm_options::add);
            const auto found = plugin::insecure_plugin(home.file());
            REQUIRE(found);
            CHECK(found->message == "other users may write '" + path + "'");
            CHECK(found->hint == "a plugin is a program: 'chmod go-w '" + path + "''");
            CHECK(trusting(home.folder()).failed() == (path == home.folder()));
            fs::permissions(path, bit, fs::perm_options::remove);
        }
        if (geteuid() != 0) continue;
        CHECK(chown(path.c_str(), 12345, 0) == 0);
        REQUIRE(plugin::insecure_plugin(home.file()));
        CHECK(plugin::insecure_plugin(home.file())->message.find("belongs to another user") !=
              std::string::npos);
        CHECK(chown(path.c_str(), 0, 0) == 0);
    }
    fs::create_symlink(home.file(), home.path / "link.so");
    CHECK_FALSE(plugin::insecure_plugin(home.path / "link.so"));
    fs::permissions(home.folder(), fs::perms::others_write, fs::perm_options::add);
    CHECK(plugin::insecure_plugin(home.path / "link.so"));
}

TEST_CASE("A folder that others may replace is not secure") {
    const Home home;
    const auto inner = home.path / "plugins/deep/er";
    fs::create_directories(inner);
    std::ofstream(inner / "a.so") << "x";
    for (const auto& p : {inner.parent_path(), inner, inner / "a.so"})
        fs::permissions(p, fs::perms::owner_all);
    CHECK_FALSE(plugin::insecure_plugin(inner / "a.so"));
    fs::permissions(home.folder(), fs::perms::others_write, fs::perm_options::add);
    const auto found = plugin::insecure_plugin(inner / "a.so");
    REQUIRE(found);
    CHECK(found->message ==
          "other users may write '" + home.folder() + "', and so replace '" + inner.string() + "'");
    CHECK(found->hint == "a plugin is a program: 'chmod go-w '" + home.folder() + "''");
    CHECK(trusting(inner.string()).failed());
    fs::permissions(home.folder(), fs::perms::sticky_bit, fs::perm_options::add);
    CHECK_FALSE(plugin::insecure_plugin(inner / "a.so"));
    if (geteuid() != 0) return;
    CHECK(chown(home.folder().c_str(), 12345, 0) == 0);
    REQUIRE(plugin::insecure_plugin(inner / "a.so"));
    CHECK(plugin::insecure_plugin(inner / "a.so")->message.find("belongs to another user") !=
          std::string::npos);
    CHECK(chown(home.folder().c_str(), 0, 0) == 0);
}

TEST_CASE("A list that others may write counts for nothing") {
    const Home home;
    REQUIRE_FALSE(trusting(home.folder()).failed());
    fs::permissions(plugin::trust_list(), fs::perms::others_write, fs::perm_options::add);
    CHECK_FALSE(plugin::is_trusted(home.folder()));
    fs::permissions(plugin::trust_list(), fs::perms::others_write, fs::perm_options::remove);
    CHECK(plugin::is_trusted(home.folder()));
    const auto around = fs::path(plugin::trust_list()).parent_path();
    fs::permissions(around, fs::perms::others_write, fs::perm_options::add);  // who may replace it
    CHECK_FALSE(plugin::is_trusted(home.folder()));
    CHECK(trusting(home.folder()).failed());
}

// What pages read and write: files of the kinds of Forage, by their content, and nothing of others.
#include "tools/studio/server/page_paths.h"

#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <sys/stat.h>

#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"
#include "tools/api/edit/operations.h"
#include "tools/studio/server/commands/command.h"
#include "tools/studio/server/requests.h"

namespace {

namespace fs = std::filesystem;
using namespace forage;
using namespace forage::studio;

constexpr const char* secret = "hunter2";

/// A session in a folder of its own; all that its page is sent is a text.
struct OwnFolder {
    fs::path folder = test::temporary_path("forage-page-paths");
    std::string sent;
    std::unique_ptr<Session> session;

    OwnFolder() {
        fs::remove_all(folder), fs::create_directories(folder);
        fs::copy_file(FORAGE_SOURCE_DIR "/tests/diagnostics/sound/system.iqr", folder / "own.iqr");
        RunInput input;
        input.system = (folder / "own.iqr").string();
        session = std::make_unique<Session>(
            input, [this](int, bool, const std::string& data) { sent += data; }, "",
            (folder / "shipped").string());
        session->connect(1);
    }
    ~OwnFolder() { fs::remove_all(folder); }
    std::string path(const std::string& name) const { return (folder / name).string(); }
    std::string file(const std::string& name, const std::string& content) const {
        write_file(path(name), content);
        return path(name);
    }
    json ask(const json& command) {
        json reply = session->execute(1, command);
        sent += reply.dump();
        return reply;
    }
    json status() const {
        json out = session->status();
        out.erase("generation");
        return out;
    }
};

/// A value of a type, with `path` as each path.
json argument_of(const ValueType& type, const std::string& path) {
    switch (type.kind) {
        case ValueType::Kind::path:
            return path;
        case ValueType::Kind::boolean:
            return true;
        case ValueType::Kind::whole:
        case ValueType::Kind::number:
            return static_cast<std::int64_t>(std::max(type.low, 0.));
        case ValueType::Kind::choice:
            return type.choices.front();
        case ValueType::Kind::list:
            return json::array({argument_of(type.element[0], path)});
        case ValueType::Kind::record:
            return {{"dock", 1}};
        default:
            return "P/A";
    }
}

/// A command that names `path` wherever it takes a path; null when it takes none.
json naming(const Command& command, const std::string& path) {
    json out = {{"command", command.name}};
    bool takes_path = false;
    for (const auto& m : command.arguments) {
        const bool is_path = m.type.kind == ValueType::Kind::path;
        takes_path = takes_path || is_path;
        if (is_path || m.required()) out[m.name] = argument_of(m.type, path);
        if (m.name == "overwrite") out[m.name] = true;
    }
    return takes_path ? out : json();
}

constexpr const char* endings[] = {".iqr",   ".iqrProcess",  ".world", ".conf", ".hconf",
                                   ".pconf", ".layout.json", ".txt",   ".csv",  ".dat",
                                   ".npy",   ".h5",          ".xml",   ""};

}  // namespace

TEST_CASE("no command shows or replaces a file of another kind, whatever its name is") {
    OwnFolder f;
    const std::string contents[] = {fmt::format("root:x:0:0:{0}:/root:/bin/sh\n{0}\n", secret),
                                    fmt::format("<{0}><a b=\"{0}\"/></{0}>", secret),
                                    fmt::format("{{\"auths\": {{\"a\": \"{}\"}}}}", secret),
                                    fmt::format("1 2 3\n{}\n", secret),
                                    std::string("\x7f"
                                                "ELF\0hunter2",
                                                12)};
    for (const auto& content : contents) {
        const auto target = f.file("target", content);
        for (const char* ending : endings) {
            const auto file = f.file(fmt::format("file{}", ending), content),
                       link = f.path(fmt::format("link{}", ending));
            fs::remove(link), fs::create_symlink(target, link);
            const std::string paths[] = {file, link, file + std::string("\0.iqr", 5), "../target",
                                         "../" + file};
            for (const auto& path : paths)
                for (const auto& command : commands())
                    if (json message = naming(command, path); !message.is_null()) {
                        INFO(message.dump());
                        f.ask(message);
                        if (command.name == "open")
                            message["shipped"] = true, f.ask(message);
                        else if (command.name == "sample")
                            for (const char* mode : {"overwrite", "append"})
                                message["mode"] = mode, f.ask(message);
                        CHECK(f.session->edited.document->path() == f.path("own.iqr"));
                        CHECK(read_file(file) == content);
                        CHECK(read_file(target) == content);
                    }
            f.ask({{"command", "text_edit"},
                   {"text",
                    fmt::format(R"(<System id="s" name="x"><Process id="p" name="P" path="{}"/></System>)",
                                file)}});
            f.ask({{"command", "document"}}), f.ask({{"command", "undo"}});
            for (const char* what : {"import", "use_part"})
                f.ask({{"command", "edit"}, {"operations", {{{"do", what}, {"file", file}}}}});
            const auto id = f.session->edited.document->system().processes.front().id;
            const json made = f.ask(
                {{"command", "edit"},
                 {"operations", {{{"do", "make_part"}, {"id", id}, {"file", file}, {"overwrite", true}}}}});
            CHECK(made["ok"] == false);
            CHECK(read_file(file) == content);
        }
    }
    CHECK(f.sent.find(secret) == std::string::npos);
}

TEST_CASE("modules of an edited system read and write tables and weights only") {
    for (const auto& [type, parameter] : {std::pair{"moduleReplay", "file"}, {"moduleAL", "File Name"}}) {
        OwnFolder f;
        const std::string content = fmt::format("root:x:0:{}\n", secret);
        const auto file = f.file("data.csv", content);
        const auto process = f.session->edited.document->system().processes.front().id;
        json operations = {{{"do", "type"}, {"id", process}, {"part", "module"}, {"type", type}},
                           {{"do", "parameter"}, {"id", process}, {"name", parameter}, {"value", file}}};
        if (type == std::string("moduleAL"))
            for (const char* flag : {"read", "write"})
                operations.push_back(
                    {{"do", "parameter"}, {"id", process}, {"name", flag}, {"value", "true"}});
        f.ask({{"command", "edit"}, {"operations", operations}});
        CHECK_FALSE(f.session->edited.current);
        CHECK(f.sent.find("data.csv' is not a") != std::string::npos);
        f.ask({{"command", "step"}, {"cycles", 2}});
        f.ask({{"command", "document"}}), f.ask({{"command", "item"}, {"item", process}});
        CHECK(f.sent.find(secret) == std::string::npos);
        CHECK(read_file(file) == content);
    }
}

TEST_CASE("modules of an edited system open cameras and gamepads only") {
    for (const std::string type : {"moduleVideo", "moduleJoystick"}) {
        const std::string kind = type == "moduleVideo" ? "camera" : "gamepad";
        OwnFolder f;
        const auto process = f.session->edited.document->system().processes.front().id;
        const auto pipe = f.path("pipe");
        REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
        const auto edit = [&](const std::string& device) {
            f.sent.clear();
            f.ask({{"command", "edit"},
                   {"operations",
                    {{{"do", "type"}, {"id", process}, {"part", "module"}, {"type", type}},
                     {{"do", "parameter"}, {"id", process}, {"name", "DeviceName"}, {"value", device}}}}});
            return f.sent;
        };
        const auto secrets = f.file("secrets", fmt::format("root:x:0:{}\n", secret));
        CHECK(edit(secrets).find(fmt::format("secrets' is not a {}", kind)) != std::string::npos);
        for (const auto& device : {pipe, std::string("/dev/zero"), std::string("/dev/../dev/zero")})
            CHECK(edit(device).find("' is not a file") != std::string::npos);
        for (const auto& device : {f.path("none"), f.file("empty", "")})  // which the module reports
            CHECK(edit(device).find("' is not a ") == std::string::npos);
        const auto* module = f.session->run().registry().module(type);
        REQUIRE(module);
        const auto& parameter = *find_by(module->parameters, "DeviceName", &Parameter::name);
        CHECK_THROWS_AS(check_parameter_file(type, parameter, secrets), InputError);
        CHECK_NOTHROW(check_parameter_file(type, parameter, ""));
        if (parameter.is_path)  // relative to the system's file
            CHECK(edit("secrets").find(fmt::format("secrets' is not a {}", kind)) != std::string::npos);
    }
}

namespace {

/// A module as a plugin may bring it.
struct FileModule {
    std::string file, name;
    static void describe(ModuleSpec<FileModule>& s) {
        s.name("moduleFile", "File");
        s.param("file", &FileModule::file).label("File").path().doc("What it reads.");
        s.param("name", &FileModule::name).label("Name").doc("No file.");
    }
    void update(ModuleFrame&) {}
};

}  // namespace

TEST_CASE("a module of a plugin names files, and no devices") {
    OwnFolder f;
    Registry registry;
    registry.add(module_type<FileModule>());
    const auto found = [&](const char* parameter, const std::string& value) {
        model::System system;
        auto& module = system.processes.emplace_back().module.emplace();
        module.type = "moduleFile";
        module.settings.push_back({parameter, value, {}, {}});
        Diagnostics diagnostics;
        const bool sound = check_system_files(system, registry, diagnostics);
        CHECK(sound != diagnostics.failed());
        return format(diagnostics);
    };
    CHECK(found("file", "/dev/zero").find("'/dev/zero' is not a file") != std::string::npos);
    CHECK(found("file", f.file("sound.wav", "RIFF")).empty());
    CHECK(found("file", "").empty());
    CHECK(found("name", "/dev/zero").empty());
}

TEST_CASE("operations read and replace processes only, whatever member names the file") {
    OwnFolder f;
    const std::string content = fmt::format("root:x:0:{}\n", secret);
    const auto file = f.file("data.iqrProcess", content);
    const auto process = f.session->edited.document->system().processes.front().id;
    int with_path = 0;
    for (const auto& operation : editing::system_operations()) {
        json o = {{"do", operation.name}, {"id", process}, {"overwrite", true}};
        bool has_path = false;
        for (const auto& m : operation.members) {
            if (m.type.kind != ValueType::Kind::path) continue;
            o[m.name] = file, has_path = true;
        }
        if (!has_path) continue;
        ++with_path;
        INFO(operation.name);
        CHECK_THROWS_AS(check_operation_files(*f.session, json::array({o})), InputError);
        CHECK(f.ask({{"command", "edit"}, {"operations", {o}}})["ok"] == false);
        CHECK(read_file(file) == content);
    }
    CHECK(with_path >= 3);
    CHECK(f.sent.find(secret) == std::string::npos);
}

TEST_CASE("weights and initial values of an edited system are files of numbers") {
    OwnFolder f;
    const auto connection = f.session->edited.document->system().connections.front().id;
    const auto pattern = [](const std::string& file) {
        return json{{"form", "weights"}, {"file", file}, {"list", false}, {"text", ""}};
    };
    const auto secrets = f.file("secrets.csv", fmt::format("{} {}\n", secret, secret));
    const json preview =
        f.ask({{"command", "preview"}, {"connection", connection}, {"pattern", pattern(secrets)}});
    CHECK(preview["problems"][0]["message"] == "'" + secrets + "' is not a file of numbers");
    f.ask({{"command", "edit"},
           {"operations", {{{"do", "pattern"}, {"id", connection}, {"pattern", pattern(secrets)}}}}});
    CHECK_FALSE(f.session->edited.current);
    CHECK(f.sent.find("secrets.csv' is not a file of numbers") != std::string::npos);
    CHECK(f.sent.find(secret) == std::string::npos);
    for (const char* numbers :
         {"1,2,3\n", "source,target,weight\n0,0,1\n", "a,0.5\nb,nan\n", "\x93NUMPY", ""})
        CHECK(is_of_kind(numbers, FileKind::numbers));
    for (const char* other : {"root:x:0:0:root:/root\n", "a,b\n", "<System/>"})
        CHECK_FALSE(is_of_kind(other, FileKind::numbers));
}

TEST_CASE("messages about arrays of an edited system have nothing of other files") {
    OwnFolder f;
    std::string text = read_file(f.path("own.iqr"));
    for (const auto& content : {fmt::format("root:x:0:{}\n", secret), fmt::format("{} 2\n", secret),
                                fmt::format("cycle,{}\n1,{}\n", secret, secret)}) {
        const auto file = f.file("w.csv", content);
        std::string changed = text;
        const auto at = changed.find("<Neuron ");
        const auto end = changed.find('>', at);
        REQUIRE(end != text.npos);
        changed.replace(at, changed.find("</Neuron>", at) + 9 - at,
                        fmt::format("<Neuron name=\"neuronLinearThreshold\"><Initial state=\"vm\" "
                                    "file=\"{}\"/></Neuron>",
                                    file));
        f.ask({{"command", "text_edit"}, {"text", changed}});
        f.ask({{"command", "document"}});
        CHECK_FALSE(f.session->edited.current);
    }
    CHECK(f.sent.find("w.csv") != std::string::npos);
    CHECK(f.sent.find(secret) == std::string::npos);
}

TEST_CASE("recorded events of a gamepad are recognized") {
    using namespace std::string_literals;
    const std::string button = "\1\0\0\0\1\0\1\0"s, start = "\1\0\0\0\1\0\x82\1"s;
    const std::string event = "\1\0\0\0\0\0\0\0\x3f\x42\x0f\0\0\0\0\0\3\0\0\0\1\0\0\0"s;
    CHECK(is_of_kind(button + start + "\1\0"s, FileKind::gamepad));
    CHECK(is_of_kind(event + event, FileKind::gamepad));
    CHECK_FALSE(is_of_kind(button + "\1\0\0\0\1\0\3\0"s, FileKind::gamepad));
    CHECK_FALSE(is_of_kind(event + "root:x:0:0:root:/root:/bin/sh", FileKind::gamepad));
    CHECK_FALSE(is_of_kind("root:x:0:0:root:/root:/bin/sh", FileKind::gamepad));
    CHECK_FALSE(is_of_kind("abc", FileKind::gamepad));
    CHECK_FALSE(is_of_kind("abc", FileKind::camera));
}

TEST_CASE("files of the right kind are read, also damaged ones and through links") {
    OwnFolder f;
    const auto damaged =
        f.file("damaged.iqr", "<?xml version=\"1.0\"?>\n<!-- why -->\n<System id=\"a\"><Process");
    fs::create_symlink(damaged, f.path("link.iqr"));
    for (const auto& path : {damaged, f.path("link.iqr")})
        CHECK(f.ask({{"command", "open"}, {"system", path}})["ok"] == true);
    CHECK(is_of_kind("\xef\xbb\xbf <sdf version='1.6'>", FileKind::world));
    CHECK(is_of_kind("<gazebo>", FileKind::world));
    CHECK_FALSE(is_of_kind("<worlds>", FileKind::world));
    CHECK_FALSE(is_of_kind("x <System>", FileKind::system));
    CHECK(is_of_kind("# any\n1, 2\n3;4\t5\r\n\n", FileKind::patterns));
    for (const auto kind : {FileKind::patterns, FileKind::table, FileKind::recording})
        CHECK_FALSE(is_of_kind("# nothing but a remark\n", kind));
    CHECK(is_of_kind("cycle,a\n0,1\n", FileKind::recording));
    CHECK(is_of_kind("# \"A\"=g1\ncycle;g1_act_0;\n", FileKind::recording));
    CHECK(is_of_kind("\x93NUMPY\x01", FileKind::recording));
    CHECK_FALSE(is_of_kind("cycles of life\n", FileKind::recording));
    CHECK(is_of_kind("cycle,process,target,v0\n-1,a b,c,1,2\n", FileKind::table));
    CHECK_FALSE(is_of_kind("-1,a b,c,1,2\n0,a,b,x\n", FileKind::table));
    for (const auto kind : {FileKind::system, FileKind::layout, FileKind::recording})
        CHECK(is_of_kind("", kind));
}

TEST_CASE("pipes, devices and folders are refused at once") {
    OwnFolder f;
    const auto pipe = f.path("pipe");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    fs::create_directory(f.path("folder"));
    for (const auto& path : {pipe, std::string("/dev/zero"), f.path("folder")}) {
        CHECK_THROWS_AS(check_readable(path, {FileKind::system}), InputError);
        for (const auto& command : commands())
            if (const json message = naming(command, path); !message.is_null() && command.name != "files") {
                INFO(message.dump());
                CHECK((f.ask(message)["ok"] == false || command.name == "layout_convert"));
            }
    }
}

TEST_CASE("files are written in folders that exist, under names of their kind") {
    OwnFolder f;
    const auto sample = [&](const std::string& path, const char* mode) {
        return f.ask({{"command", "sample"}, {"file", path}, {"sources", {"P/A"}}, {"mode", mode}});
    };
    CHECK(sample(f.path("new/light.csv"), "sequence")["ok"] == false);
    CHECK_FALSE(fs::exists(f.path("new")));
    fs::create_symlink(f.path("nothing"), f.path("dangling.csv"));
    CHECK(sample(f.path("dangling.csv"), "overwrite")["ok"] == false);
    fs::create_symlink(f.file("target", "mine"), f.path("light.csv.part"));
    CHECK(sample(f.path("light.csv"), "new")["ok"] == false);
    CHECK(read_file(f.path("target")) == "mine");
    f.file("old.csv", "cycle,P/A(1,1)\n0,1\n");
    CHECK(sample(f.path("old.csv"), "overwrite")["ok"] == true);
    f.ask({{"command", "sample_stop"}});
    CHECK(f.ask({{"command", "save"}, {"file", f.path("other.txt")}})["ok"] == false);
    CHECK(f.ask({{"command", "save"}, {"file", f.path("other.iqr")}})["ok"] == true);
    CHECK(f.ask({{"command", "save"}, {"file", f.path("own.iqr")}})["reason"] == "file_exists");
    CHECK(f.ask({{"command", "save"}, {"file", f.path("own.iqr")}, {"overwrite", true}})["ok"] == true);
}

TEST_CASE("a refused command leaves no trace") {
    OwnFolder f;
    f.ask({{"command", "step"}, {"cycles", 20}});
    f.ask({{"command", "sample"}, {"file", f.path("a.csv")}, {"sources", {"P/A"}}});
    const json before = f.status();
    for (const char* refused :
         {R"({"command": "sample", "automatic": true})",
          R"({"command": "sample", "file": null, "sources": null, "automatic": true})",
          R"({"command": "sample", "file": "x.csv", "sources": ["Nothing"], "automatic": true})",
          R"({"command": "seek", "cycle": 3})", R"({"command": "compare", "cycle": 3})",
          R"({"command": "open", "system": "/nothing.iqr"})",
          R"({"command": "world_open", "world": "/nothing.world"})",
          R"({"command": "speed", "mode": "times", "value": 0})"}) {
        INFO(refused);
        CHECK(f.ask(json::parse(refused))["ok"] == false);
        CHECK(f.status() == before);
    }
    f.ask({{"command", "sample_stop"}});
    const json stopped = f.status();
    for (const auto& how : {json{{"sources", {"Nothing"}}, {"file", f.path("b.csv")}},
                            json{{"sources", json::array()}, {"file", f.path("b.csv")}},
                            json{{"sources", {"P/A"}}, {"file", f.path("none/b.csv")}},
                            json{{"sources", {"P/A"}}, {"file", f.path("b.h5")}, {"mode", "append"}},
                            json{{"sources", {"P/A"}}, {"file", f.path("b.pdf")}}}) {
        json command = how;
        command["command"] = "sample", command["automatic"] = true;
        INFO(command.dump());
        CHECK(f.ask(command)["ok"] == false);
        CHECK(f.status() == stopped);
    }
    f.session->work(1e6);
}

TEST_CASE("a message that nests too deeply is refused before it is parsed, with its number") {
    OwnFolder f;
    const auto reply_to = [&](const std::string& text) {
        f.sent.clear(), f.session->message(1, text);
        return json::parse(f.sent);
    };
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    CHECK(refusal_of(R"({"id": 3, "x": )" + nested(99) + "}") == std::nullopt);
    REQUIRE(refusal_of(R"({"id": 3, "x": )" + nested(100) + "}"));
    CHECK(json::parse(*refusal_of(R"({"id": 3, "x": )" + nested(100) + "}"))["id"] == 3);
    CHECK(reply_to(R"({"id":)" + nested(100'000) + "}")["id"].is_null());
    CHECK(refusal_of(R"({"text": "[[[\"[[[[{{{", "x": 1})" + std::string(3, ' ')) == std::nullopt);
    std::string many = R"({"x": [0)";
    for (int i = 0; i < 1'000'001; ++i) many += ",0";
    CHECK(refusal_of(many + "]}"));
    CHECK(refusal_of(R"({"text": ")" + std::string(5'000'000, ',') + "\"}") == std::nullopt);
}

// What is made of the table of commands: types of the page, tables of the docs, seeds of the fuzzer. With
// FORAGE_REWRITE_EXPECTATIONS=1 the files are written; otherwise they are compared.
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/output_files.h"
#include "tests/support/paths.h"
#include "tests/support/studio_protocol.h"
#include "tools/api/edit/operations.h"
#include "tools/api/edit/world_operations.h"

namespace {

using namespace forage;
using namespace forage::studio;

const std::string root = FORAGE_SOURCE_DIR "/";
const std::string docs = root + "docs/design/studio-protocol.md";

void expect_file(const std::string& path, const std::string& content) {
    if (std::getenv("FORAGE_REWRITE_EXPECTATIONS")) return write_file(path, content);
    const auto kept = read_file(path);
    const auto differs = std::ranges::mismatch(kept, content);
    const auto line = std::count(kept.begin(), differs.in1, '\n') + 1;
    INFO(path << ":" << line << " differs: run ./tools/update-docs");
    CHECK(kept.size() == content.size());
    CHECK((differs.in1 == kept.end() && differs.in2 == content.end()));
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (auto at = text.find(what); at != text.npos; at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    return text;
}

// ---- the types of the page ----

std::string typescript_of(const Command& c) {
    const auto arguments = arguments_of(c);
    return fmt::format("  /** {} */\n  {}: {{\n    arguments: {};\n    result: {};\n  }};\n", c.doc, c.name,
                       arguments.empty() ? "{}" : in_typescript(record(arguments)), c.result);
}

/// The union of the types of operations.
template <class Edit>
std::string typescript_of(const std::string& name, const std::vector<editing::Operation<Edit>>& operations) {
    std::string out = "\nexport type " + name + " =";
    for (const auto& o : operations) {
        auto members = o.members;
        members.insert(members.begin(), {"do", any("'" + o.name + "'")});
        out += "\n  | " + in_typescript(record(members));
    }
    return out + ";\n";
}

std::string page_module() {
    std::set<std::string> names;
    std::string body = "export interface Commands {\n";
    for (const auto& c : commands()) body += typescript_of(c);
    for (const auto& c : commands()) {
        std::string types = c.result + " ";
        for (const auto& m : c.arguments) types += in_typescript(m.type) + " ";
        std::string word;
        for (const char l : types)
            if (std::isalnum(static_cast<unsigned char>(l)))
                word += l;
            else if (std::isupper(static_cast<unsigned char>(word[0])) && word != "Record" &&
                     !word.ends_with("Operation"))
                names.insert(std::exchange(word, ""));
            else
                word.clear();
    }
    return fmt::format(
        "// The commands of the server. Made by tests/unit/tools/studio/server/protocol_test.cpp from "
        "tools/studio/server/commands.\n"
        "import type {{ {} }} from './messages';\n\n{}}}\n{}{}",
        fmt::join(names, ", "), body, typescript_of("Operation", editing::system_operations()),
        typescript_of("WorldOperation", editing::world_operations()));
}

// ---- the tables of the docs ----

std::string documented(const Member& m) {
    std::string out = "`" + m.name + "`";
    if (!m.required() && !m.otherwise.is_null() && m.otherwise != "")
        out += fmt::format(" ({})", m.otherwise.dump());
    if (!m.required() && (m.otherwise.is_null() || m.otherwise == "")) out += " (optional)";
    std::vector<std::string> said;
    if (m.type.kind == ValueType::Kind::list || m.type.kind == ValueType::Kind::record)
        said.push_back("`" + in_typescript(m.type) + "`");
    else if (m.type.kind != ValueType::Kind::boolean && m.type.kind != ValueType::Kind::any &&
             ((m.type.kind != ValueType::Kind::text && m.type.kind != ValueType::Kind::path) ||
              m.doc.empty()))
        said.push_back(in_words(m.type));
    if (!m.doc.empty()) said.push_back(m.doc);
    return said.empty() ? out : fmt::format("{}: {}", out, fmt::join(said, ", "));
}

std::string row_of(const std::string& name, const std::vector<Member>& members, const std::string& doc) {
    std::vector<std::string> out;
    for (const auto& m : members) out.push_back(documented(m));
    return fmt::format("| `{}` | {} | {} |\n", name, fmt::join(out, "<br>"), doc);
}

std::string row_of(const Command& c) {
    const bool none = c.result == "{}";
    return row_of(c.name, c.arguments, c.doc + (none ? "" : " `" + replaced(c.result, "|", "\\|") + "`"));
}

/// The docs with the table of operations between the mark and "<!-- end of operations -->".
template <class Edit>
std::string with_operations(std::string text, const std::string& mark,
                            const std::vector<editing::Operation<Edit>>& operations) {
    std::string table = "\n| `do` | members | what it does |\n|---|---|---|\n";
    for (const auto& o : operations) table += row_of(o.name, o.members, o.doc);
    const auto at = text.find(mark);
    REQUIRE(at != text.npos);
    const auto begin = text.find('\n', at) + 1, end = text.find("<!-- end of operations -->", begin);
    return text.replace(begin, end - begin, table + "\n");
}

/// The docs with the rows after each mark "<!-- commands: run to quit -->".
std::string documented_page(std::string text) {
    const std::string mark = "<!-- commands: ", end = "<!-- end of commands -->";
    std::size_t shown = 0;
    for (auto at = text.find(mark); at != text.npos; at = text.find(mark, at + 1)) {
        const auto names = text.substr(at + mark.size(), text.find(" -->", at) - at - mark.size());
        const auto first = names.substr(0, names.find(" to ")), last = names.substr(names.find(" to ") + 4);
        std::string table = "| command | arguments | what it does, and its result |\n|---|---|---|\n";
        bool inside = false;
        for (const auto& c : commands()) {
            inside = inside || c.name == first;
            if (inside) table += row_of(c), ++shown;
            if (inside && c.name == last) break;
        }
        const auto begin = text.find('\n', at) + 1;
        text.replace(begin, text.find(end, begin) - begin, "\n" + table + "\n");
    }
    CHECK(shown == commands().size());
    text = with_operations(std::move(text), "<!-- operations on a system -->", editing::system_operations());
    return with_operations(std::move(text), "<!-- operations on a world -->", editing::world_operations());
}

// ---- the seeds of the fuzzer ----

json seed_value(const Member& m) {
    static const std::map<std::string, json> known = {
        {"assignments", {"Try/Cells.threshold=0.5"}},
        {"connection", "c1"},
        {"content", {{"dock", nullptr}}},
        {"file", "x.txt"},
        {"group", "Try/Cells"},
        {"item", "Try/Cells"},
        {"ids", {"g1"}},
        {"operations", {{{"do", "rename"}, {"id", "g1"}, {"name", "B"}}}},
        {"patterns", {{1, 2, 3}}},
        {"pattern", {{"form", "mapped"}, {"mapping", "all"}}},
        {"source", "Try/Cells"},
        {"sources", {"Try/Cells"}}};
    const bool is_text = m.type.kind == ValueType::Kind::text || m.type.kind == ValueType::Kind::path ||
                         m.type.kind == ValueType::Kind::list || m.type.kind == ValueType::Kind::any ||
                         m.type.kind == ValueType::Kind::record;
    if (const auto it = known.find(m.name); is_text && it != known.end()) return it->second;
    switch (m.type.kind) {
        case ValueType::Kind::boolean:
            return true;
        case ValueType::Kind::whole:
        case ValueType::Kind::number:
            return static_cast<std::int64_t>(std::max(m.type.low, 1.));
        case ValueType::Kind::choice:
            return m.type.choices.back();
        case ValueType::Kind::list:
            return json::array();
        case ValueType::Kind::text:
        case ValueType::Kind::path:
            return "x";
        case ValueType::Kind::any:
        case ValueType::Kind::record:
            break;
    }
    return json::object();
}

/// Each command with the arguments that it needs, and with all that it may have.
std::string seeds() {
    std::string out;
    for (const auto& c : commands()) {
        nlohmann::ordered_json least = {{"id", 1}, {"command", c.name}}, all = least;
        for (const auto& m : c.arguments) {
            all[m.name] = seed_value(m);
            if (m.required()) least[m.name] = all[m.name];
        }
        if (c.changes_run) all["generation"] = 0;
        out += least.dump() + "\n";
        if (all != least) out += all.dump() + "\n";
    }
    return out;
}

}  // namespace

TEST_CASE("the page's types of commands are those of the server") {
    expect_file(root + "tools/studio/web/src/protocol/commands.ts", page_module());
}

TEST_CASE("the docs of the protocol list every command") {
    expect_file(docs, documented_page(read_file(docs)));
}

TEST_CASE("the seeds of the fuzzer have every command") {
    expect_file(root + "tests/fuzz/studio/commands.txt", seeds());
}

TEST_CASE("the messages in the docs have the types of the page") {
    const auto text = read_file(docs);
    std::size_t count = 0;
    for (auto at = text.find("\n{\"type\": \""); at != text.npos; at = text.find("\n{\"type\": \"", at + 1)) {
        std::size_t end = at;
        while (!json::accept(text.substr(at, end - at)) && text.substr(end + 1, 3) != "```")
            end = text.find('\n', end + 1);
        test::check_message(json::parse(text.substr(at, end - at)));
        ++count;
    }
    CHECK(count >= 8);
}

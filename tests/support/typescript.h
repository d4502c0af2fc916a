// Compares JSON values with types of TypeScript, as far as the protocol of the studio uses them.
#pragma once

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace forage::test {

/// The exported types of a module.
class TypeScript {
  public:
    explicit TypeScript(const std::string& module) {
        for (auto at = module.find("\nexport "); at != module.npos; at = module.find("\nexport ", at + 1)) {
            Reader in{module, at + 8};
            if (const auto kind = in.word(); kind == "interface") {
                const auto name = in.word();
                Type all{Type::Kind::both, {}, {}, {}};
                if (in.takes("extends")) do
                        all.inner.push_back(in.single());
                    while (in.takes(","));
                all.inner.push_back(in.single());
                types_[name] = all;
            } else if (kind == "type") {
                const auto name = in.word();
                in.expect("=");
                types_[name] = in.type();
            }
        }
    }

    /// What does not have the type, such as "trials.last: 3"; empty when all has it.
    std::string mismatch(const nlohmann::json& value, const std::string& type) const {
        Reader in{type, 0};
        return mismatch(value, in.type(), "");
    }

  private:
    struct Type {
        enum class Kind { name, literal, list, tuple, record, either, both, map };
        Kind kind = Kind::name;
        std::string text;
        std::vector<Type> inner;
        std::map<std::string, std::pair<Type, bool>> members;  ///< and whether they are optional
    };
    using Members = std::map<std::string, std::pair<Type, bool>>;

    struct Reader {
        std::string_view text;
        std::size_t at;

        void skip() {
            while (at < text.size()) {
                if (std::isspace(static_cast<unsigned char>(text[at])))
                    ++at;
                else if (text.substr(at, 2) == "/*")
                    at = text.find("*/", at) + 2;
                else
                    return;
            }
        }
        bool takes(std::string_view token) {
            skip();
            if (!text.substr(at).starts_with(token)) return false;
            at += token.size();
            return true;
        }
        void expect(std::string_view token) {
            if (!takes(token))
                throw std::runtime_error("there is no '" + std::string(token) + "' at " +
                                         std::string(text.substr(at, 40)));
        }
        std::string word() {
            skip();
            const auto begin = at;
            while (at < text.size() &&
                   (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_'))
                ++at;
            return std::string(text.substr(begin, at - begin));
        }
        Type single() {
            Type out;
            if (takes("(")) {
                out = type();
                expect(")");
            } else if (takes("'")) {
                const auto end = text.find('\'', at);
                out = {Type::Kind::literal, std::string(text.substr(at, end - at)), {}, {}};
                at = end + 1;
            } else if (takes("[")) {
                out.kind = Type::Kind::tuple;
                do out.inner.push_back(type());
                while (takes(","));
                expect("]");
            } else if (takes("{")) {
                out.kind = Type::Kind::record;
                while (!takes("}")) {
                    if (takes("[")) {  // any other members
                        word(), expect(": string]:"), type();
                        out.members[""] = {{}, true};
                        takes(";");
                        continue;
                    }
                    const auto name = word();
                    const bool optional = takes("?");
                    expect(":");
                    out.members[name] = {type(), optional};
                    takes(";");
                }
            } else if ((out.text = word()) == "Record") {
                expect("<string,");
                out = {Type::Kind::map, {}, {type()}, {}};
                expect(">");
            }
            while (takes("[]")) out = {Type::Kind::list, {}, {out}, {}};
            return out;
        }
        Type several(const char* sign, Type::Kind kind, Type (Reader::*part)()) {
            takes(sign);
            Type out{kind, {}, {(this->*part)()}, {}};
            while (takes(sign)) out.inner.push_back((this->*part)());
            return out.inner.size() == 1 ? Type(out.inner[0]) : out;
        }
        Type both() { return several("&", Type::Kind::both, &Reader::single); }
        Type type() { return several("|", Type::Kind::either, &Reader::both); }
    };

    Members members_of(const Type& type) const {
        if (type.kind == Type::Kind::name) return members_of(types_.at(type.text));
        Members out = type.members;
        for (const auto& part : type.inner) out.merge(members_of(part));
        return out;
    }

    std::string mismatch(const nlohmann::json& value, const Type& type, const std::string& where) const {
        const auto wrong = [&](bool right) { return right ? "" : where + ": " + value.dump().substr(0, 80); };
        const auto elements = [&](bool same) {
            std::string found;
            for (std::size_t i = 0; i < value.size() && found.empty(); ++i)
                found = mismatch(value[i], type.inner[same ? 0 : i], where + "[" + std::to_string(i) + "]");
            return found;
        };
        switch (type.kind) {
            case Type::Kind::name:
                if (type.text == "string") return wrong(value.is_string());
                if (type.text == "number") return wrong(value.is_number());
                if (type.text == "boolean") return wrong(value.is_boolean());
                if (type.text == "true") return wrong(value == true);
                if (type.text == "null") return wrong(value.is_null());
                if (type.text == "unknown") return "";
                if (!types_.contains(type.text)) throw std::runtime_error("there is no type " + type.text);
                return mismatch(value, types_.at(type.text), where);
            case Type::Kind::literal:
                return wrong(value == type.text);
            case Type::Kind::list:
                return value.is_array() ? elements(true) : wrong(false);
            case Type::Kind::tuple:
                return value.is_array() && value.size() == type.inner.size() ? elements(false) : wrong(false);
            case Type::Kind::map:
                for (const auto& [name, member] : value.items())
                    if (auto found = mismatch(member, type.inner[0], where + "." + name); !found.empty())
                        return found;
                return wrong(value.is_object());
            case Type::Kind::either: {
                std::string deepest;
                for (const auto& each : type.inner) {
                    auto found = mismatch(value, each, where);
                    if (found.empty()) return "";
                    if (found.find(':') >= deepest.find(':') || deepest.empty()) deepest = std::move(found);
                }
                return deepest;
            }
            case Type::Kind::both:
            case Type::Kind::record:
                break;
        }
        const auto members = members_of(type);
        if (!value.is_object()) return wrong(false);
        for (const auto& [name, member] : value.items())
            if (!members.contains(name) && !members.contains(""))
                return where + "." + name + ": is not a member";
        for (const auto& [name, member] : members) {
            const auto it = value.find(name);
            if (it == value.end() && !member.second) return where + "." + name + ": is missing";
            if (it == value.end()) continue;
            if (auto found = mismatch(*it, member.first, where + "." + name); !found.empty()) return found;
        }
        return "";
    }

    std::map<std::string, Type> types_;
};

}  // namespace forage::test

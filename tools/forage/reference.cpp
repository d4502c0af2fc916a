// The manual page and the shell completion, from the same declarations as --help.
#include <vector>

#include <fmt/format.h>

#include "core/base/print.h"
#include "core/base/separated.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

/// An option or a positional argument.
struct Argument {
    std::vector<std::string> shorts, longs;  ///< without dashes; both empty: positional
    std::string value;                       ///< "FILE"; empty for a flag
    std::string text;
    std::vector<std::string> choices;
    bool files() const {
        return value.find("FILE") != std::string::npos || value.find("DIR") != std::string::npos;
    }
};

std::vector<Argument> arguments(const CLI::App& app) {
    std::vector<Argument> out;
    for (const CLI::Option* o : app.get_options()) {
        Argument a{o->get_snames(), o->get_lnames(), o->get_option_text(), o->get_description(), {}};
        if (a.value.empty() && a.shorts.empty() && a.longs.empty()) a.value = o->get_name(true);
        // A set of choices is part of the type's name: "TEXT:{png,svg,pdf}".
        const std::string type = o->get_type_name();
        if (const auto open = type.find('{'); open != std::string::npos)
            a.choices = CLI::detail::split(type.substr(open + 1, type.find('}') - open - 1), ',');
        out.push_back(std::move(a));
    }
    return out;
}

std::vector<const CLI::App*> commands(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

std::string names_of(const Argument& a) {
    std::string out;
    for (const auto& s : a.shorts) out += (out.empty() ? "-" : ", -") + s;
    for (const auto& l : a.longs) out += (out.empty() ? "--" : ", --") + l;
    return out;
}

std::string roff(const std::string& text) {
    std::string out = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
    out = replaced(replaced(out, "\n.", "\n\\&."), "\n'", "\n\\&'");
    return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

void add_options(std::string& out, const CLI::App& app) {
    for (const auto& a : arguments(app)) {
        const std::string names = names_of(a);
        out += fmt::format(".TP\n\\fB{}\\fR{}\\fI{}\\fR\n{}\n", roff(names),
                           names.empty() || a.value.empty() ? "" : " ", roff(a.value), roff(a.text));
    }
}

/// Quotes a text with single quotes, in a way that every shell understands.
std::string quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

std::string bash(const CLI::App& app) {
    std::string names, values, options;
    for (const auto* c : commands(app)) {
        names += (names.empty() ? "" : " ") + c->get_name();
        std::string all;
        for (const auto& a : arguments(*c)) {
            for (const auto& l : a.longs) all += (all.empty() ? "--" : " --") + l;
            if (a.choices.empty()) continue;
            for (const auto& l : a.longs)
                values +=
                    fmt::format("        '{} --{}') COMPREPLY=($(compgen -W '{}' -- \"$cur\")); return;;\n",
                                c->get_name(), l, separated(a.choices, " "));
            if (a.longs.empty())
                values +=
                    fmt::format("        '{0} {0}') COMPREPLY=($(compgen -W '{1}' -- \"$cur\")); return;;\n",
                                c->get_name(), separated(a.choices, " "));
        }
        options +=
            fmt::format("        {}) COMPREPLY=($(compgen -W '{}' -- \"$cur\"));;\n", c->get_name(), all);
    }
    return fmt::format(
        R"(# bash completion of forage: source it, or put it in ~/.local/share/bash-completion/completions/forage
_forage() {{
    local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}}
    if [ "$COMP_CWORD" -eq 1 ]; then COMPREPLY=($(compgen -W '{} --help --version' -- "$cur")); return; fi
    case "${{COMP_WORDS[1]}} $prev" in
{}    esac
    if [[ $cur != -* ]]; then COMPREPLY=($(compgen -f -- "$cur")); return; fi
    case ${{COMP_WORDS[1]}} in
{}    esac
}}
complete -o filenames -F _forage forage
)",
        names, values, options);
}

std::string zsh(const CLI::App& app) {
    // In a description of _arguments, brackets end the text and colons are separators.
    const auto plain = [](const std::string& text) {
        return replaced(replaced(replaced(text, "[", "("), "]", ")"), ":", "\\:");
    };
    std::string names, cases;
    for (const auto* c : commands(app)) {
        names += fmt::format(" {}", quoted(c->get_name() + ":" + plain(c->get_description())));
        cases += fmt::format("        {}) _arguments", c->get_name());
        for (const auto& a : arguments(*c)) {
            const std::string action = !a.choices.empty() ? fmt::format("({})", separated(a.choices, " "))
                                       : a.files()        ? "_files"
                                                          : "";
            const std::string value = a.value.empty() ? "" : fmt::format(":{}:{}", plain(a.value), action);
            if (a.longs.empty() && a.shorts.empty()) cases += " " + quoted("*" + value);
            for (const auto& l : a.longs)
                cases += " " + quoted(fmt::format("*--{}[{}]{}", l, plain(a.text), value));
        }
        cases += ";;\n";
    }
    return fmt::format(R"(#compdef forage
# zsh completion of forage: put it as _forage in a directory of $fpath
local -a commands=({})
if (( CURRENT == 2 )); then
    _describe command commands
else
    local command=$words[2]
    shift words
    (( CURRENT-- ))
    case $command in
{}    esac
fi
)",
                       names, cases);
}

std::string fish(const CLI::App& app) {
    const auto quote = [](const std::string& text) {
        return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
    };
    std::string out = "# fish completion of forage: put it in ~/.config/fish/completions/forage.fish\n";
    for (const auto* c : commands(app))
        out += fmt::format("complete -c forage -n __fish_use_subcommand -f -a {} -d {}\n", c->get_name(),
                           quote(c->get_description()));
    for (const auto* c : commands(app))
        for (const auto& a : arguments(*c)) {
            std::string line =
                fmt::format("complete -c forage -n '__fish_seen_subcommand_from {}'", c->get_name());
            for (const auto& s : a.shorts) line += " -s " + s;
            for (const auto& l : a.longs) line += " -l " + l;
            if (!a.choices.empty())
                line += fmt::format(" -x -a '{}'", separated(a.choices, " "));
            else if (!a.value.empty() && !(a.longs.empty() && a.shorts.empty()))
                line += a.files() ? " -r" : " -x";
            if (a.longs.empty() && a.shorts.empty() && a.choices.empty())
                continue;  // fish completes file names itself
            out += line + " -d " + quote(a.text) + "\n";
        }
    return out;
}

/// The manual page of the program and all its commands, in roff, section 1.
std::string man_page(const CLI::App& app) {
    std::string out = fmt::format(
        ".TH FORAGE 1 \"\" \"forage {}\" \"User Commands\"\n.SH NAME\nforage \\- {}\n", FORAGE_VERSION,
        roff("runs iqr brain models headless, in a closed loop with a simulated robot"));
    out += ".SH SYNOPSIS\n.B forage\n.I COMMAND\n.RI [ OPTION ...]\n.SH COMMANDS\n";
    for (const auto* c : commands(app)) {
        out += fmt::format(".SS forage {}\n{}.\n", roff(c->get_name()), roff(c->get_description()));
        add_options(out, *c);
        if (const std::string footer = c->get_footer(); !footer.empty())
            out += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(footer));
    }
    return out +
           ".SH EXIT STATUS\n0 when all went well, 1 when a run failed, 2 for bad usage or bad input.\n";
}

}  // namespace

void add_completion(Program& program) {
    auto& shell = program.options<std::string>();
    auto& command = program.add("completion", "Print a script that completes command lines", [&] {
        const auto& app = program.app();
        print("{}", shell == "bash" ? bash(app) : shell == "zsh" ? zsh(app) : fish(app));
        return fine;
    });
    command.footer("Example:\n  forage completion bash > ~/.local/share/bash-completion/completions/forage");
    add_value(command, "SHELL", shell, " ", "bash, zsh or fish")
        ->required()
        ->check(one_of({"bash", "zsh", "fish"}));
}

void add_man(Program& program) {
    program
        .add("man", "Print the manual page",
             [&program] { return print("{}", man_page(program.app())), fine; })
        .footer("Example:\n  forage man > forage.1; man ./forage.1");
}

}  // namespace forage::tool

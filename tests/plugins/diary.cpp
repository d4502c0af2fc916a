// A module that keeps a diary in a file of the run, and reads a stream that cannot be copied.
#include <fstream>
#include <memory>
#include <mutex>

#include <forage/plugin.h>

struct Diary {
    std::string name = "diary.log", other, script;

    static void describe(forage::ModuleSpec<Diary>& s) {
        s.name("moduleDiary", "Diary").doc("Writes what it reads into a file.");
        s.param("name", &Diary::name).at_start().doc("Name of the diary.");
        s.param("other", &Diary::other).at_start().doc("Name of a second file.");
        s.param("script", &Diary::script).path().at_start().doc("File with a first line.");
        s.input("in", "What is written down");
    }
    void start(const forage::ModulePorts& ports) {
        diary = &ports.open(name);
        if (!other.empty()) ports.open(other) << "other\n";
        std::string line;
        input.open(script);
        std::getline(input, line);
        *diary << ports.system << ' ' << ports.process << " seed " << ports.seed << ' ' << line << '\n';
        late = ports;
    }
    void update(forage::ModuleFrame& frame) {
        if (name == "late" && frame.cycle() == 2) late.open("more");
        *diary << frame.cycle() << ' ' << frame.input(0).sum() << '\n';
    }
    void checkpoint(forage::Archive&) {}
    ~Diary() {
        if (diary) *diary << "a line after the end\n";
    }

    forage::ModulePorts late;
    std::ifstream input;
    std::unique_ptr<int> owned;
    std::mutex mutex;
    std::ostream* diary = nullptr;
};

FORAGE_PLUGIN(Diary);

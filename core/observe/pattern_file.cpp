#include "core/observe/pattern_file.h"

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/types/parameter.h"

namespace forage::observe {
namespace {

class PatternReader {
  public:
    PatternReader(std::shared_ptr<const SourceFile> file, const GroupShape& shape, Diagnostics& out)
        : file_(std::move(file)),
          sparse_(shape.cells != shape.width * shape.height),
          width_(sparse_ ? shape.cells : shape.width),
          height_(sparse_ ? 1 : shape.height),
          out_(out),
          errors_before_(out.errors()) {}

    std::vector<std::vector<double>> run() {
        std::string_view rest = file_->text;
        for (int number = 1; !rest.empty() && out_.errors() < errors_before_ + most_faults; ++number) {
            const auto end = std::min(rest.find('\n'), rest.size());
            line(rest.substr(0, end), number);
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        finish();
        if (patterns_.empty() && out_.errors() == errors_before_)
            out_.error({file_, 0, 0}, "there are no patterns in it",
                       fmt::format("a pattern is {}; an empty line stands between patterns", form()));
        if (out_.errors() > errors_before_) return {};
        return std::move(patterns_);
    }

  private:
    static constexpr int most_faults = 100;

    std::string form() const {
        return fmt::format("{} row{} of {} number{}", height_, height_ == 1 ? "" : "s", width_,
                           width_ == 1 ? "" : "s");
    }

    void line(std::string_view text, int number) {
        constexpr std::string_view between = " \t\r,;";
        std::size_t at = text.find_first_not_of(between);
        if (at == std::string_view::npos) return finish();
        if (text[at] == '#') return;
        int count = 0;
        while (at != std::string_view::npos && out_.errors() < errors_before_ + most_faults) {
            const auto end = std::min(text.find_first_of(between, at), text.size());
            const auto word = text.substr(at, end - at);
            const auto value = parse_parameter(ParameterKind::real, word);
            if (!value)
                out_.error({file_, number, static_cast<int>(at) + 1}, no_number(word),
                           "a pattern holds finite numbers with a decimal point and blanks between them");
            sound_ = sound_ && value;
            pattern_.push_back(value ? std::get<double>(*value) : 0);
            ++count;
            at = text.find_first_not_of(between, end);
        }
        if (sound_ && count != width_)
            out_.error({file_, number, 1},
                       fmt::format("{} number{} in a row, not {}", count, count == 1 ? "" : "s", width_),
                       sparse_ ? "the group is sparse: a pattern is one row with a number per cell"
                               : "a row has as many numbers as the group has columns");
        ++rows_;
        last_row_ = number;
    }

    void finish() {
        if (rows_ == 0) return;
        if (sound_ && rows_ != height_)
            out_.error({file_, last_row_, 1},
                       fmt::format("a pattern ends here after {} row{}, not {}", rows_, rows_ == 1 ? "" : "s",
                                   height_),
                       "a pattern has as many rows as the group; an empty line stands between patterns");
        patterns_.push_back(std::move(pattern_));
        pattern_.clear();
        rows_ = 0;
        sound_ = true;
    }

    std::shared_ptr<const SourceFile> file_;
    bool sparse_;
    int width_, height_, rows_ = 0, last_row_ = 0;
    bool sound_ = true;  ///< the words of this pattern are numbers
    Diagnostics& out_;
    const int errors_before_;
    std::vector<double> pattern_;
    std::vector<std::vector<double>> patterns_;
};

}  // namespace

std::vector<std::vector<double>> parse_patterns(const std::string& text, const std::string& path,
                                                const GroupShape& shape, Diagnostics& diagnostics) {
    auto file = std::make_shared<SourceFile>(SourceFile{path, text});
    if (auto error = not_lines(text, "these are no patterns")) {
        error->where.file = std::move(file);
        if (error->hint.empty()) error->hint = "a list of patterns is a text";
        diagnostics.add(std::move(*error));
        return {};
    }
    return PatternReader(std::move(file), shape, diagnostics).run();
}

std::vector<std::vector<double>> read_patterns(const std::string& path, const GroupShape& shape,
                                               Diagnostics& diagnostics) {
    constexpr std::size_t most = std::size_t{128} << 20;
    const auto text = read_file(path, most, diagnostics);
    return text ? parse_patterns(*text, path, shape, diagnostics) : std::vector<std::vector<double>>();
}

}  // namespace forage::observe

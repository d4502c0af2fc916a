#include "core/base/table.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

namespace forage {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";
constexpr std::size_t max_fields_of_text = std::size_t{1} << 24, max_fields_of_file = std::size_t{1} << 20,
                      longest_line = std::size_t{64} << 20, block_size = std::size_t{1} << 16;

std::string_view trimmed(std::string_view text) {
    const auto first = std::min(text.find_first_not_of(blanks), text.size());
    return text.substr(first, text.find_last_not_of(blanks) + 1 - first);  // npos + 1 is 0
}

/// Whether a field was meant as a number: also nan, inf, 0x10, 1e999, and those of a JSON list.
bool resembles_number(std::string_view field) {
    field.remove_prefix(std::min(field.find_first_not_of('['), field.size()));
    field = field.substr(0, field.find_last_not_of(']') + 1);  // npos + 1 is 0
    if (field.starts_with('"')) field = field.substr(1, field.find('"', 1) - 1);
    const std::string text(field);
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !text.empty() && end == text.c_str() + text.size();
}

/// Whether one of the first rows of a text is one of a table: it begins with a number (or names the columns,
/// from `cycle` on). Where blanks divide fields, too, half of them are numbers.
bool has_row_of_numbers(std::string_view text, bool commas_only) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    int rows = 0;
    while (rows < 64 && !text.empty()) {
        const auto line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const auto row = trimmed(line).substr(0, 4096);
        if (row.empty() || row.starts_with('#')) continue;
        if (row == "cycle" || row.starts_with("cycle,") || row.starts_with("cycle;")) return true;
        const std::string_view separators = commas_only ? ",;\t" : " \t,;";
        std::size_t fields = 0, numbers = 0;
        for (auto at = row.find_first_not_of(separators); at < row.size();) {
            const auto end = std::min(row.find_first_of(separators, at), row.size());
            const bool is_number = resembles_number(trimmed(row.substr(at, end - at)));
            if (fields++ == 0 && !is_number) break;
            numbers += is_number ? 1 : 0;
            at = row.find_first_not_of(separators, end);
        }
        if (numbers > 0 && (commas_only || 2 * numbers >= fields)) return true;
        rows += fields > 0 ? 1 : 0;
    }
    return rows == 0;  // there is nothing to quote
}

}  // namespace

TableReader::TableReader(std::string_view text, std::string path, Layout layout, std::string_view refusal,
                         std::string_view hint)
    : source_(std::make_shared<SourceFile>(
          SourceFile{std::move(path), std::string(text.substr(0, std::size_t{1} << 20))})),
      refusal_(refusal),
      layout_(layout),
      max_fields_(max_fields_of_text),
      text_(text) {
    if (auto wrong = not_lines(text, refusal)) {
        if (wrong->hint.empty()) wrong->hint = hint;
        throw FileError(source_, {std::move(*wrong)});
    }
}

TableReader::TableReader(std::ifstream file, std::string path)
    : source_(std::make_shared<SourceFile>(SourceFile{std::move(path), {}})),
      max_fields_(max_fields_of_file),
      file_(std::move(file)) {}

bool TableReader::read_header() {
    if (!next()) return false;
    columns_.assign(fields_.begin(), fields_.end());
    return true;
}

std::size_t TableReader::column(std::string_view name) {
    const auto found = std::ranges::find(columns_, name);
    if (found != columns_.end()) return static_cast<std::size_t>(found - columns_.begin());
    refuse(row_, fmt::format("there is no column '{}'", name), suggest(name, columns_));
}

bool TableReader::next() {
    while (!full() && take_line()) {
        row_ = line_;
        if (number_ == 1 && row_.starts_with("\xEF\xBB\xBF")) row_.remove_prefix(3);
        row_ = trimmed(row_);
        if (layout_ != Layout::list && row_.starts_with('#')) continue;
        split();
        if (fields_.empty() && layout_ == Layout::csv) continue;
        if (columns_.empty() || fields_.size() == columns_.size()) return true;
        fault(row_, fmt::format("{} fields in this row, not {}", fields_.size(), columns_.size()),
              "the first row names the columns");
    }
    return false;
}

bool TableReader::take_line() {
    std::size_t end = layout_ == Layout::list ? text_.npos : text_.find('\n');
    while (end == text_.npos && file_.is_open()) {
        const std::size_t searched = text_.size();
        if (searched > longest_line) {
            line_ = row_ = text_, ++number_;
            fault(row_, "the line is too long");
            return false;
        }
        if (!read_more()) return false;
        end = text_.find('\n', searched);
    }
    if (text_.empty() && (number_ > 0 || layout_ != Layout::list)) return false;
    ++number_;
    line_ = text_.substr(0, end);
    text_.remove_prefix(std::min(line_.size() + 1, text_.size()));
    return true;
}

/// Keeps the rest of the block, and appends the next one.
bool TableReader::read_more() {
    block_.erase(0, block_.size() - text_.size());
    const std::size_t kept = block_.size();
    block_.resize(kept + block_size);
    file_.read(block_.data() + kept, block_size);
    block_.resize(kept + static_cast<std::size_t>(file_.gcount()));
    text_ = block_;
    return block_.size() > kept;
}

void TableReader::split() {
    fields_.clear();
    if (row_.empty()) return;
    const bool any = layout_ == Layout::blocks;  // several separators count as one
    constexpr std::string_view separators = " \t\r\v\f,;";
    for (std::size_t at = 0; at <= row_.size() && fields_.size() <= max_fields_;) {
        if (any && (at = row_.find_first_not_of(separators, at)) == row_.npos) return;
        const auto rest = row_.substr(at);
        if (layout_ == Layout::csv && rest.starts_with('"')) {  // RFC 4180; a doubled quote stays doubled
            auto close = rest.find('"', 1);
            while (close != rest.npos && rest.substr(close).starts_with("\"\""))
                close = rest.find('"', close + 2);
            if (const auto after = rest.substr(std::min(close, rest.size() - 1) + 1);
                close != rest.npos && (after.empty() || after.starts_with(','))) {
                fields_.push_back(rest.substr(1, close - 1));
                at += close + 2;
                continue;
            }
        }
        const auto end = std::min(any ? row_.find_first_of(separators, at) : row_.find(',', at), row_.size());
        fields_.push_back(trimmed(row_.substr(at, end - at)));
        at = end + 1;
    }
    if (layout_ == Layout::list && fields_.back().empty()) fields_.pop_back();
    if (fields_.size() > max_fields_) {
        fault(row_, fmt::format("more than {} fields in a row", max_fields_));
        fields_.clear();
    }
}

std::pair<int, int> TableReader::place(std::string_view piece) const {
    const auto before = line_.substr(0, static_cast<std::size_t>(piece.data() - line_.data()));
    return {number_ + static_cast<int>(std::ranges::count(before, '\n')),
            static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1};  // npos + 1 is 0
}

void TableReader::fault(std::pair<int, int> place, std::string message, std::string_view hint) {
    if (!full())
        faults_.push_back(error_at(place.first, place.second, std::move(message), std::string(hint)));
}

void TableReader::require_sound() const {
    if (failed()) fail();
}

void TableReader::fail() const {
    if (source_->path.empty() || refusal_.empty() ||
        has_row_of_numbers(source_->text, layout_ == Layout::csv))
        throw FileError(source_, faults_);
    refuse(fmt::format("{}: no row begins with a number", refusal_));
}

void TableReader::require_whole() {
    if (!text_.empty() && !full()) fault({number_ + 1, 1}, "the file ends within this row");
    require_sound();
}

void TableReader::refuse(std::string message, std::string_view hint) const {
    throw FileError(source_, {error_at(0, 0, std::move(message), std::string(hint))});
}
void TableReader::refuse(std::string_view piece, std::string message, std::string_view hint) {
    fault(piece, std::move(message), hint);
    fail();
}

}  // namespace forage

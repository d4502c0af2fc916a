#include "core/base/array.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/number.h"
#include "core/base/table.h"
#include "core/base/text_file.h"

namespace forage {
namespace {

static_assert(std::endian::native == std::endian::little,
              "numbers of .npy files are read without conversion");

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t max_text = std::size_t{2} << 30, max_numbers = std::size_t{2} << 30,
                      max_kept = std::size_t{1} << 28;  ///< in memory

/// The head of a .npy file (NumPy's NEP 1).
struct NpyHead {
    std::string type;
    bool by_column = false;
    std::vector<std::size_t> shape;
    std::size_t length = 0;  ///< bytes before the first number
};

/// The whole numbers of a text such as "(2, 3)", which may have more behind it. Empty when it is none.
std::vector<std::size_t> read_shape(std::string_view text) {
    std::vector<std::size_t> out;
    text = text.substr(0, text.find(')'));
    while (!text.empty()) {
        text.remove_prefix(std::min(text.find_first_of("0123456789"), text.size()));
        const auto size = take_number<std::size_t>(text);
        if (!text.empty() && !size) return {};
        if (size) out.push_back(*size);
    }
    return out;
}

/// What stands after "'key': " in the text of a head.
std::string_view entry(std::string_view text, std::string_view key) {
    const auto at = text.find(fmt::format("'{}':", key));
    if (at == text.npos) return {};
    text.remove_prefix(at + key.size() + 3);
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    return text;
}

std::optional<NpyHead> read_head(std::string_view bytes) {
    if (bytes.size() < 12) return {};
    const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(bytes[i])}; };
    const bool wide = byte(6) >= 2;  // the version
    const std::size_t first = wide ? 12 : 10,
                      size = byte(8) | byte(9) << 8 | (wide ? byte(10) << 16 | byte(11) << 24 : 0);
    if (bytes.size() < first + size) return {};
    const auto text = bytes.substr(first, size);
    NpyHead out;
    out.length = first + size;
    const auto type = entry(text, "descr"), shape = entry(text, "shape");
    out.by_column = entry(text, "fortran_order").starts_with("True");
    if (!shape.starts_with('(')) return {};
    if (type.starts_with('\'')) out.type = type.substr(1, type.find('\'', 1) - 1);
    out.shape = read_shape(shape);
    // A recording: records of a cycle and the numbers of its cells or synapses. Its last record counts.
    constexpr std::string_view record = "[('cycle', '<u8'), ('", numbers = "'<f8', (";
    if (const auto at = type.find(numbers); type.starts_with(record) && at != type.npos) {
        const std::size_t records = out.shape.empty() ? 0 : out.shape[0];
        out.shape = read_shape(type.substr(at + numbers.size()));
        if (records == 0 || out.shape.size() != 2 || out.shape[0] == 0 ||
            out.shape[1] > max_numbers / out.shape[0])
            return {};
        out.type = "<f8";
        const std::size_t record_size = sizeof(double) * (1 + out.shape[0] * out.shape[1]);
        if (records > (std::size_t{1} << 62) / record_size) return {};
        out.length += (records - 1) * record_size + sizeof(double);
    }
    return out;
}

/// Reads numbers of a type as doubles.
template <class T>
double number_at(const char* bytes) {
    T out;
    std::memcpy(&out, bytes, sizeof out);
    return static_cast<double>(out);
}
struct NumberType {
    std::string_view name;
    std::size_t size;
    double (*read)(const char*);
};
constexpr NumberType number_types[] = {
    {"<f8", 8, number_at<double>},        {"<f4", 4, number_at<float>},
    {"<i8", 8, number_at<std::int64_t>},  {"<i4", 4, number_at<std::int32_t>},
    {"<i2", 2, number_at<std::int16_t>},  {"|i1", 1, number_at<std::int8_t>},
    {"<u8", 8, number_at<std::uint64_t>}, {"<u4", 4, number_at<std::uint32_t>},
    {"<u2", 2, number_at<std::uint16_t>}, {"|u1", 1, number_at<std::uint8_t>},
    {"|b1", 1, number_at<std::uint8_t>},
};

/// Reads as many bytes as there are, at most `size`.
std::size_t read_at(int file, std::uint64_t offset, char* to, std::size_t size) {
    std::size_t done = 0;
    while (done < size) {
        const auto n = pread(file, to + done, size - done, static_cast<off_t>(offset + done));
        if (n <= 0) break;
        done += static_cast<std::size_t>(n);
    }
    return done;
}

bool is_nan_word(std::string_view field) {
    return field.size() == 3 && std::ranges::equal(field, std::string_view("nan"), [](char a, char b) {
               return std::tolower(static_cast<unsigned char>(a)) == b;
           });
}

/// Whether a row of a list or a matrix holds names.
bool is_heading(const std::vector<std::string_view>& fields) {
    return std::ranges::none_of(
        fields, [](std::string_view f) { return f.empty() || is_nan_word(f) || parse_number<double>(f); });
}

}  // namespace

Array::~Array() {
    if (file_ >= 0) close(file_);
}

std::shared_ptr<const Array> Array::read(const std::string& path, Form form, std::string_view column) {
    std::shared_ptr<Array> out(new Array);
    out->path_ = path;
    out->source_ = std::make_shared<SourceFile>(SourceFile{path, {}});
    try {
        open_file(path);  // throws, with the reason
        struct stat about {};
        out->file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
        if (out->file_ < 0 || fstat(out->file_, &about) != 0)
            throw FileError(path, {}, {error_at(0, 0, "cannot read the file")});
        out->stamp_ = {static_cast<std::int64_t>(about.st_dev),
                       static_cast<std::int64_t>(about.st_ino),
                       about.st_size,
                       about.st_mtim.tv_sec,
                       about.st_mtim.tv_nsec,
                       static_cast<int>(form)};
        std::string head(std::size_t{1} << 17, '\0');
        head.resize(read_at(out->file_, 0, head.data(), head.size()));
        if (head.starts_with("\x93NUMPY")) {
            if (!column.empty())
                out->fault("a .npy file has no columns with names", "leave out 'column', or use a CSV file");
            else
                out->read_npy(head, static_cast<std::uint64_t>(about.st_size));
        } else {
            const std::string text = read_file(path, max_text);
            TableReader reader(text, path, TableReader::Layout::csv, "this is not a table of numbers",
                               "write a .npy file, or CSV: rows of numbers with commas between them");
            out->source_ = reader.file();
            out->read_rows(reader, form, column, false);
        }
        if (out->faults_.empty()) out->scan();
    } catch (const FileError& e) {
        out->source_ = e.file(), out->faults_ = e.errors();
    } catch (const std::bad_alloc&) {
        out->fault("there is not enough memory for the file");
    }
    if (out->offset_ == 0 && out->file_ >= 0) close(std::exchange(out->file_, -1));  // it is in memory
    return out;
}

std::shared_ptr<const Array> Array::parse(std::string_view text, Form form, const Location& at) {
    std::shared_ptr<Array> out(new Array);
    out->at_ = at;
    try {
        TableReader reader(text, {}, TableReader::Layout::blocks, "these are no numbers");
        out->read_rows(reader, form, {}, true);
        out->scan();
    } catch (const FileError& e) {
        for (Diagnostic d : e.errors()) {
            const int line = std::max(d.where.line, 1), column = std::max(d.where.column, 1);
            d.where = at;
            d.where.line = at.line + line - 1, d.where.column = line > 1 ? column : at.column + column - 1;
            out->faults_.push_back(std::move(d));
        }
    }
    return out;
}

void Array::fault(std::string message, std::string hint) {
    faults_.push_back(error_at(0, 0, std::move(message), std::move(hint)));
    faults_.back().where = source_ ? Location{source_} : at_;
}

void Array::read_npy(std::string_view bytes, std::uint64_t size) {
    const auto head = read_head(bytes);
    if (!head) return fault("the head of this .npy file is damaged", "write it with numpy.save()");
    const auto* type = std::ranges::find(number_types, head->type, &NumberType::name);
    if (type == std::end(number_types))
        return fault(head->type.empty()
                         ? "this .npy file holds records, not plain numbers"
                         : fmt::format("this .npy file holds numbers of the type '{}'", head->type),
                     "convert it: numpy.save(file, array.astype(float))");
    if (head->shape.empty() || head->shape.size() > 2)
        return fault(fmt::format("this .npy file has {} dimensions", head->shape.size()),
                     "an array has one or two: reshape it");
    is_vector_ = head->shape.size() == 1;
    rows_ = head->shape[0], columns_ = is_vector_ ? 1 : head->shape[1];
    if (columns_ > 0 && rows_ > max_numbers / columns_)
        return fault(fmt::format("{} x {} numbers are too many", rows_, columns_),
                     fmt::format("an array has at most {} numbers", max_numbers));
    const std::size_t count = rows_ * columns_;
    if (size < head->length + count * type->size)
        return fault(fmt::format("the file ends early: {} x {} numbers take {} bytes, and there are {}",
                                 rows_, columns_, count * type->size,
                                 size - std::min<std::uint64_t>(size, head->length)));
    const bool as_they_lie = type->name == "<f8" && (!head->by_column || rows_ <= 1 || columns_ <= 1);
    if (as_they_lie) {
        offset_ = head->length;
        return;
    }
    if (count > max_kept)
        return fault(
            fmt::format("{} x {} numbers are too many for this kind of .npy file", rows_, columns_),
            "numpy.save(file, numpy.ascontiguousarray(array, dtype=float)) writes one that need not be "
            "converted");
    values_.resize(count);
    constexpr std::size_t block = std::size_t{1} << 16;
    std::vector<char> some(block * type->size);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t in_block = i % block;
        if (in_block == 0) {
            const std::size_t wanted = std::min(block, count - i) * type->size;
            if (read_at(file_, head->length + i * type->size, some.data(), wanted) < wanted)
                return fault("cannot read the file");
        }
        const std::size_t place = head->by_column ? i % rows_ * columns_ + i / rows_ : i;
        values_[place] = type->read(some.data() + in_block * type->size);
    }
}

void Array::read_rows(TableReader& reader, Form form, std::string_view column, bool one_text) {
    const char* hint = "numbers have a decimal point; 'nan' stands for none";
    std::size_t wanted = 0;
    if (form == Form::column) {
        if (!reader.read_header()) reader.refuse("the file is empty");
        wanted = reader.column(column), columns_ = 1;
    }
    for (bool first = true; reader.next(); first = false) {
        const auto& fields = reader.fields();
        if (fields.empty()) continue;
        if (first && reader.row().find_first_of("[];") != std::string_view::npos)
            reader.refuse(reader.row(), "a row has numbers and ',' or blanks between them",
                          "each row stands on a line of its own, without brackets or ';'");
        const int line = reader.place(reader.row()).first;
        const auto take = [&](std::string_view field) {
            const bool none = field.empty() || is_nan_word(field);
            if (none && form == Form::list) reader.fault(field, "a number is left out", "remove the row");
            values_.push_back(none ? nan : reader.number(field, hint));
        };
        if (form == Form::column) {
            take(fields[wanted]);
        } else {
            if (first && is_heading(fields)) {
                if (form == Form::list) continue;
                reader.refuse(reader.row(), fmt::format("'{}' is not a number", escaped(fields.front())),
                              "a table whose first row has names: name one with column=\"...\"; a list of "
                              "source, target, weight: form=\"list\"");
            }
            if (form == Form::list && (fields.size() < 3 || fields.size() > 4))
                reader.refuse(
                    reader.row(), fmt::format("a row of a list has 3 or 4 numbers, not {}", fields.size()),
                    "source, target, weight and perhaps delay; without form=\"list\", it is a matrix");
            if (columns_ > 0 && fields.size() != columns_)
                reader.fault(reader.row(),
                             fmt::format("a row of {} number{}, not {}", fields.size(),
                                         fields.size() == 1 ? "" : "s", columns_),
                             "all rows are of the same length");
            if (columns_ == 0) columns_ = fields.size();
            for (const auto field : fields) take(field);
        }
        ++rows_, lines_.push_back(one_text ? at_.line + line - 1 : line);
    }
    reader.require_sound();
}

/// Counts what is left out, and finds the first number that is not finite. Returns whether there are numbers.
bool Array::scan() {
    const std::size_t count = rows_ * columns_;
    constexpr std::size_t block = std::size_t{1} << 18;
    const std::size_t step = std::max<std::size_t>(1, block / std::max<std::size_t>(columns_, 1));
    std::vector<double> some;
    for (std::size_t row = 0; row < rows_ && columns_ > 0; row += step) {
        const std::size_t rows = std::min(step, rows_ - row), n = rows * columns_;
        const double* values = values_.data() + row * columns_;
        if (values_.empty()) {
            some.resize(step * columns_);
            copy(row, rows, some.data()), values = some.data();
        }
        double sum = 0;  // not finite when one of them is not
        for (std::size_t i = 0; i < n; ++i) sum += values[i] - values[i];
        if (sum == 0) continue;
        for (std::size_t i = 0; i < n; ++i) {
            left_out_ += std::isnan(values[i]);
            if (!std::isinf(values[i]) || !faults_.empty()) continue;
            fault(
                fmt::format("the number in row {}, column {} is infinite", row + i / columns_, i % columns_),
                "rows and columns count from 0; nan stands for none");
        }
    }
    if (left_out_ == count) fault("there are no numbers in it");
    return left_out_ < count;
}

void Array::copy(std::size_t first, std::size_t count, double* to) const {
    const std::size_t n = count * columns_;
    if (!values_.empty()) {
        std::copy_n(values_.data() + first * columns_, n, to);
        return;
    }
    const std::size_t bytes = n * sizeof(double);
    if (read_at(file_, offset_ + first * columns_ * sizeof(double), reinterpret_cast<char*>(to), bytes) <
        bytes)
        throw FileError(path_, {}, {error_at(0, 0, "the file changed while it was read")});
}

std::vector<double> Array::numbers() const {
    std::vector<double> out(rows_ * columns_);
    copy(0, rows_, out.data());
    return out;
}

Location Array::place(std::size_t row) const {
    Location out = source_ ? Location{source_} : at_;
    if (row < lines_.size()) out.line = lines_[row], out.column = 1;
    return out;
}

std::string Array::row_name(std::size_t row) const {
    if (path_.empty()) return fmt::format("row {} of the text", row);
    return row < lines_.size() ? fmt::format("'{}', line {}", path_, lines_[row])
                               : fmt::format("row {} of '{}'", row, path_);
}

bool Array::operator==(const Array& other) const {
    if (!stamp_.empty() || !other.stamp_.empty()) return stamp_ == other.stamp_;
    return rows_ == other.rows_ && columns_ == other.columns_ &&
           std::ranges::equal(values_, other.values_, [](double a, double b) {
               return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
           });
}

}  // namespace forage

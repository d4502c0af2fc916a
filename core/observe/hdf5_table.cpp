#include <stdexcept>

#include <fmt/format.h>

#include "core/observe/disk_space.h"
#include "core/observe/hdf5_set.h"
#include "core/observe/table_records.h"

namespace forage::observe {

void write_hdf5_table(const std::string& path, std::span<const TableColumn> columns, std::size_t rows) {
    const Records records(columns, rows, false);
    Hdf5Handle file = create_hdf5(path);
    DiskSpace space(path);
    space.reserve(records.size * (rows + records.rows_of_a_block()) + (1 << 20));
    const Hdf5Handle type(H5Tcreate(H5T_COMPOUND, records.size), H5Tclose, "make a type");
    for (const auto& field : records.fields) {
        const Hdf5Handle text = hdf5_text(field.size);
        const hid_t kind = field.texts() ? static_cast<hid_t>(text)
                           : std::holds_alternative<TableColumn::Counts>(field.column->values)
                               ? H5T_STD_U64LE
                               : H5T_IEEE_F64LE;
        check_hdf5(H5Tinsert(type, field.column->name.c_str(), field.at, kind), "add a column");
    }
    {
        GrowingSet set(file, "/table", type, type, {}, records.rows_of_a_block());
        records.for_each_block(rows, [&](const std::vector<char>& bytes, std::size_t count) {
            set.append(bytes.data(), count);
        });
    }
    if (!file.close()) throw std::runtime_error(fmt::format("cannot write '{}'", path));
}

}  // namespace forage::observe

// Data sets and attributes of HDF5 files, whose bytes depend on their content only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/observe/hdf5_handle.h"

namespace forage::observe {

/// Throws std::runtime_error when `status` is that of a failure.
void check_hdf5(herr_t status, const std::string& what);

/// A type of texts of `bytes` bytes in UTF-8, with zeros at the end of shorter ones.
Hdf5Handle hdf5_text(std::size_t bytes);

void add_attribute(hid_t object, const std::string& name, const std::string& text);
void add_attribute(hid_t object, const std::string& name, std::int64_t value);

/// Creates a file. Throws std::runtime_error.
Hdf5Handle create_hdf5(const std::string& path);

/// A data set that grows along its first dimension.
class GrowingSet {
  public:
    /// Rows have the shape `row`. The groups above `place` are created.
    GrowingSet(hid_t file, const std::string& place, hid_t disk_type, hid_t memory_type,
               std::vector<hsize_t> row, std::size_t rows_of_a_chunk);
    hid_t id() const { return set_; }
    /// Adds rows, and writes them to the file.
    void append(const void* rows, hsize_t count);

  private:
    int rank() const { return static_cast<int>(shape_.size()); }
    Hdf5Handle set_;
    hid_t memory_type_;
    std::vector<hsize_t> shape_;
};

}  // namespace forage::observe

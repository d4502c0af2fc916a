// Owning handles of HDF5's identifiers.
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>

namespace forage::observe {

class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Hdf5Handle() = default;
    /// Throws std::runtime_error when `id` is invalid; `what` names the action that failed.
    Hdf5Handle(hid_t id, Close closer, const std::string& what) : id_(id), close_(closer) {
        if (id < 0) throw std::runtime_error(fmt::format("HDF5: cannot {}", what));
    }
    Hdf5Handle(Hdf5Handle&& other) noexcept
        : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
        std::swap(id_, other.id_), std::swap(close_, other.close_);
        return *this;
    }
    ~Hdf5Handle() { close(); }
    bool close() {
        const hid_t id = std::exchange(id_, H5I_INVALID_HID);
        return id < 0 || close_(id) >= 0;
    }
    operator hid_t() const { return id_; }

  private:
    hid_t id_ = H5I_INVALID_HID;
    Close close_ = nullptr;
};

/// Stops HDF5 from printing errors, which Forage reports itself, and from writing failed files again at the
/// end of the program, which would crash.
inline void quiet_hdf5() {
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// How files are opened: without HDF5's locks, as file systems of clusters may have none. DirectoryHold keeps
/// other programs from writing, and a program that reads must not stop one that writes.
inline Hdf5Handle hdf5_access() {
    Hdf5Handle out(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a list");
#if H5_VERSION_GE(1, 12, 1) || (H5_VERSION_GE(1, 10, 7) && !H5_VERSION_GE(1, 12, 0))
    H5Pset_file_locking(out, false, true);
#endif
    return out;
}

/// The end of a message about a file that cannot be opened, when the environment may be the reason.
inline std::string hdf5_lock_hint() {
    const char* locks = std::getenv("HDF5_USE_FILE_LOCKING");
    return locks && std::string(locks) != "FALSE" && std::string(locks) != "0"
               ? fmt::format("; HDF5_USE_FILE_LOCKING={} is set, and FALSE is needed without locks", locks)
               : "";
}

}  // namespace forage::observe

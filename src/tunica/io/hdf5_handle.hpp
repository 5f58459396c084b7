#pragma once
#include <hdf5.h>

#include <string>
#include <utility>
#include <vector>

namespace tunica::io {

/// Owner of one HDF5 identifier, which it may stand for. Negative ones are failures.
class Hdf5Handle {
public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) {
    other.id_ = H5I_INVALID_HID;
  }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  operator hid_t() const { return id_; }
  bool is_valid() const { return id_ >= 0; }
  /// Closes before the end, where a failure matters.
  herr_t close() {
    const hid_t id = id_;
    id_ = H5I_INVALID_HID;
    return close_(id);
  }

  /// For where closing would wait for others in vain.
  void leave_open() { id_ = H5I_INVALID_HID; }

private:
  hid_t id_;
  Close close_;
};

/// Silences HDF5's own messages while it lives; ours say more.
class Hdf5Silence {
public:
  Hdf5Silence();
  ~Hdf5Silence();
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The type of strings of fixed length, UTF-8, filled up with zeros; the length that holds all of
/// some, and these one behind the other.
Hdf5Handle hdf5_string_type(std::size_t length);
std::size_t hdf5_string_length(const std::vector<std::string>& values);
std::vector<char> hdf5_text(const std::vector<std::string>& values, std::size_t length);

/// The names of what lies in a group or at the top of a file, in their alphabet's order, are
/// appended. Negative where they cannot be listed.
herr_t hdf5_names(hid_t group, std::vector<std::string>& names);

/// "fields.h5: cannot write /step_000001 (unable to …)": what HDF5 has just refused, with the
/// innermost entry of its error stack, which names the cause.
std::string hdf5_failure(const std::string& path, const std::string& action);

}  // namespace tunica::io

#include "tunica/io/hdf5_handle.hpp"

namespace tunica::io {

Hdf5Silence::Hdf5Silence() {
  H5open();
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Silence::~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

std::string hdf5_failure(const std::string& path, const std::string& action) {
  std::string cause;
  const auto keep = [](unsigned n, const H5E_error2_t* entry, void* out) -> herr_t {
    if (n == 0 && entry->desc != nullptr) *static_cast<std::string*>(out) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep, &cause);
  return path + ": cannot " + action + (cause.empty() ? cause : " (" + cause + ")");
}

}  // namespace tunica::io

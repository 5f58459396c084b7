#include "tunica/io/hdf5_handle.hpp"

#include <algorithm>

namespace tunica::io {

Hdf5Silence::Hdf5Silence() {
  H5open();
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Silence::~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

Hdf5Handle hdf5_string_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

std::size_t hdf5_string_length(const std::vector<std::string>& values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  return length;
}

std::vector<char> hdf5_text(const std::vector<std::string>& values, std::size_t length) {
  std::vector<char> text(values.size() * length + 1, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    std::copy(values[i].begin(), values[i].end(), &text[i * length]);
  return text;
}

herr_t hdf5_names(hid_t group, std::vector<std::string>& names) {
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* all) -> herr_t {
    static_cast<std::vector<std::string>*>(all)->emplace_back(name);
    return 0;
  };
  // One walk: asked for by number, each link is looked for from the first on.
  return H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
}

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

#include "tunica/io/hdf5_arrays.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "tunica/base/error.hpp"
#include "tunica/io/atomic_file.hpp"

namespace tunica::io {
namespace {

/// Deflate shrinks data at most by this factor; a dataset that claims more is damaged.
constexpr double most_compression = 1100.0;

hid_t open_file(const std::string& path) {
  TUNICA_CHECK(std::filesystem::is_regular_file(path), path + ": no such file");
  return H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
}

hid_t create_in_memory() {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, std::size_t{1} << 20, false);
  return H5Fcreate("tunica.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
}

std::string trimmed(const char* text, std::size_t length) {
  return std::string(text, std::find(text, text + length, '\0'));
}

/// Size of a string of fixed length; 0 if the type is anything else.
std::size_t string_length(hid_t type) {
  const bool is_fixed = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
  const std::size_t length = is_fixed ? H5Tget_size(type) : 0;
  return length <= 4096 ? length : 0;
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::string& path) : path_(path), file_(open_file(path), H5Fclose) {
  TUNICA_CHECK(file_.is_valid(), path + ": not an HDF5 file, or truncated");
}

void Hdf5Reader::fail(const std::string& dataset, const std::string& message) const {
  throw Error(path_ + ": dataset /" + dataset + ": " + message);
}

bool Hdf5Reader::has(const std::string& dataset) const {
  return H5Lexists(file_, dataset.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5Reader::attribute(const std::string& name, const std::string& object) const {
  const Hdf5Handle attribute = open_attribute(name, object);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
  std::vector<char> text(string_length(type));
  TUNICA_CHECK(!text.empty() && H5Sget_simple_extent_npoints(space) == 1,
               path_ + ": attribute \"" + name + "\" is not one string of fixed length");
  TUNICA_CHECK(H5Aread(attribute, type, text.data()) >= 0,
               path_ + ": attribute \"" + name + "\" cannot be read");
  return trimmed(text.data(), text.size());
}

double Hdf5Reader::number(const std::string& name, const std::string& object) const {
  const Hdf5Handle attribute = open_attribute(name, object);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
  double value = 0.0;
  TUNICA_CHECK(H5Sget_simple_extent_npoints(space) == 1 &&
                   H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) >= 0,
               path_ + ": attribute \"" + name + "\" of " + object + " is not a number");
  return value;
}

bool Hdf5Reader::has_attribute(const std::string& name, const std::string& object) const {
  return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

Hdf5Handle Hdf5Reader::open_attribute(const std::string& name, const std::string& object) const {
  Hdf5Handle attribute(
      H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  TUNICA_CHECK(attribute.is_valid(), path_ + ": " + (object == "/" ? "" : object + " ") +
                                         "has no attribute \"" + name + "\"");
  return attribute;
}

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
  const Hdf5Handle handle(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  std::vector<std::string> names;
  TUNICA_CHECK(handle.is_valid() && hdf5_names(handle, names) >= 0,
               path_ + ": the group " + group + " cannot be listed");
  return names;
}

int Hdf5Reader::columns(const std::string& dataset) const {
  const Hdf5Handle handle = open(dataset);
  const Hdf5Handle space(H5Dget_space(handle), H5Sclose);
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions != 1 && dimensions != 2) fail(dataset, "expected one or two dimensions");
  hsize_t size[2] = {0, 1};
  H5Sget_simple_extent_dims(space, size, nullptr);
  return static_cast<int>(size[1]);
}

Hdf5Handle Hdf5Reader::open(const std::string& dataset) const {
  if (!has(dataset)) fail(dataset, "missing");
  Hdf5Handle handle(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!handle.is_valid()) fail(dataset, "cannot be opened");
  return handle;
}

std::size_t Hdf5Reader::rows_of(hid_t id, const std::string& dataset, hsize_t columns) const {
  const Hdf5Handle space(H5Dget_space(id), H5Sclose);
  const Hdf5Handle type(H5Dget_type(id), H5Tclose);
  const int expected = columns == 1 ? 1 : 2;
  hsize_t size[2] = {0, 1};
  if (H5Sget_simple_extent_ndims(space) != expected)
    fail(dataset, "expected " + std::to_string(expected) + " dimension(s)");
  H5Sget_simple_extent_dims(space, size, nullptr);
  if (size[1] != columns)
    fail(dataset,
         "has " + std::to_string(size[1]) + " columns, expected " + std::to_string(columns));
  const double bytes = static_cast<double>(size[0]) * static_cast<double>(columns) *
                       static_cast<double>(H5Tget_size(type));
  const double stored = static_cast<double>(
      std::min<std::uintmax_t>(H5Dget_storage_size(id), std::filesystem::file_size(path_)));
  if (bytes > most_compression * stored)
    fail(dataset,
         "has " + std::to_string(size[0]) + " rows, more than the file can hold. Is it damaged?");
  return size[0];
}

std::size_t Hdf5Reader::rows(const std::string& dataset, hsize_t columns) const {
  return rows_of(open(dataset), dataset, columns);
}

void Hdf5Reader::read_any(hid_t id, hid_t type, const std::string& dataset, hsize_t columns,
                          hsize_t first, hsize_t count, void* to) const {
  const hsize_t all = rows_of(id, dataset, columns);
  if (first + count > all)
    fail(dataset, "has " + std::to_string(all) + " rows, expected at least " +
                      std::to_string(first + count));
  if (count == 0) return;
  const std::array<hsize_t, 2> corner{first, 0}, size{count, columns};
  const Hdf5Handle on_disk(H5Dget_space(id), H5Sclose);
  const Hdf5Handle in_memory(H5Screate_simple(columns == 1 ? 1 : 2, size.data(), nullptr),
                             H5Sclose);
  H5Sselect_hyperslab(on_disk, H5S_SELECT_SET, corner.data(), nullptr, size.data(), nullptr);
  if (H5Dread(id, type, in_memory, on_disk, H5P_DEFAULT, to) < 0)
    fail(dataset, "cannot be read. Is it damaged?");
}

void Hdf5Reader::read_integers(const std::string& dataset, hid_t type, hsize_t columns,
                               hsize_t first, hsize_t count, void* to) const {
  const Hdf5Handle handle = open(dataset);
  const Hdf5Handle on_disk(H5Dget_type(handle), H5Tclose);
  if (H5Tget_class(on_disk) != H5T_INTEGER) fail(dataset, "does not hold integers");
  read_any(handle, type, dataset, columns, first, count, to);
}

void Hdf5Reader::read(const std::string& dataset, hsize_t columns, hsize_t first, hsize_t count,
                      int* to) const {
  read_integers(dataset, H5T_NATIVE_INT, columns, first, count, to);
}

void Hdf5Reader::read(const std::string& dataset, hsize_t columns, hsize_t first, hsize_t count,
                      long long* to) const {
  read_integers(dataset, H5T_NATIVE_LLONG, columns, first, count, to);
}

void Hdf5Reader::read(const std::string& dataset, hsize_t columns, hsize_t first, hsize_t count,
                      double* to) const {
  const Hdf5Handle handle = open(dataset);
  const Hdf5Handle type(H5Dget_type(handle), H5Tclose);
  if (H5Tget_class(type) != H5T_FLOAT) fail(dataset, "does not hold real numbers");
  read_any(handle, H5T_NATIVE_DOUBLE, dataset, columns, first, count, to);
}

std::vector<int> Hdf5Reader::integers(const std::string& dataset, hsize_t columns) const {
  const std::size_t all = rows(dataset, columns);
  std::vector<int> values(all * columns);
  read(dataset, columns, 0, all, values.data());
  return values;
}

std::vector<double> Hdf5Reader::reals(const std::string& dataset, hsize_t columns) const {
  const std::size_t all = rows(dataset, columns);
  std::vector<double> values(all * columns);
  read(dataset, columns, 0, all, values.data());
  return values;
}

std::vector<std::string> Hdf5Reader::strings(const std::string& dataset) const {
  const Hdf5Handle handle = open(dataset);
  const Hdf5Handle type(H5Dget_type(handle), H5Tclose);
  const std::size_t length = string_length(type);
  if (length == 0) fail(dataset, "does not hold strings of fixed length");
  const std::size_t n = rows_of(handle, dataset, 1);
  std::vector<char> text(n * length);
  if (H5Dread(handle, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    fail(dataset, "cannot be read. Is it damaged?");
  std::vector<std::string> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(trimmed(&text[i * length], length));
  return values;
}

Hdf5Writer::Hdf5Writer(const std::string& path) : path_(path), file_(create_in_memory(), H5Fclose) {
  TUNICA_CHECK(file_.is_valid(), hdf5_failure(path, "compose the file in memory"));
}

void Hdf5Writer::attribute(const std::string& name, const std::string& value) {
  const Hdf5Handle type = hdf5_string_type(value.size());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  TUNICA_CHECK(attribute.is_valid() && H5Awrite(attribute, type, value.c_str()) >= 0,
               hdf5_failure(path_, "write attribute " + name));
}

void Hdf5Writer::write_any(const std::string& dataset, hid_t type, const void* values, hsize_t rows,
                           hsize_t columns) {
  const int rank = columns == 1 ? 1 : 2;
  const std::array<hsize_t, 2> size{rows, columns};
  const Hdf5Handle space(H5Screate_simple(rank, size.data(), nullptr), H5Sclose);
  const Hdf5Handle storage(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(storage, false);  // the same mesh gives the same file
  if (rows > 0) {
    const std::array<hsize_t, 2> chunk{std::min<hsize_t>(rows, 65536), columns};
    H5Pset_chunk(storage, rank, chunk.data());
    if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
      H5Pset_shuffle(storage);
      H5Pset_deflate(storage, 1);
    }
    H5Pset_fletcher32(storage);
  }
  const Hdf5Handle handle(
      H5Dcreate2(file_, dataset.c_str(), type, space, H5P_DEFAULT, storage, H5P_DEFAULT), H5Dclose);
  TUNICA_CHECK(
      handle.is_valid() && H5Dwrite(handle, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0,
      hdf5_failure(path_, "write /" + dataset));
}

void Hdf5Writer::write(const std::string& dataset, const int* values, hsize_t rows,
                       hsize_t columns) {
  write_any(dataset, H5T_NATIVE_INT32, values, rows, columns);
}

void Hdf5Writer::write(const std::string& dataset, const double* values, hsize_t rows,
                       hsize_t columns) {
  write_any(dataset, H5T_NATIVE_DOUBLE, values, rows, columns);
}

void Hdf5Writer::write(const std::string& dataset, const std::vector<std::string>& values) {
  const std::size_t length = hdf5_string_length(values);
  const std::vector<char> text = hdf5_text(values, length);
  write_any(dataset, hdf5_string_type(length), text.data(), values.size(), 1);
}

std::string Hdf5Writer::image() const {
  const bool is_flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = is_flushed ? H5Fget_file_image(file_, nullptr, 0) : -1;
  TUNICA_CHECK(size > 0, hdf5_failure(path_, "finish the file in memory"));
  std::string image(static_cast<std::size_t>(size), '\0');
  TUNICA_CHECK(H5Fget_file_image(file_, image.data(), image.size()) == size,
               hdf5_failure(path_, "finish the file in memory"));
  return image;
}

void Hdf5Writer::save() const { write_file(path_, image()); }

}  // namespace tunica::io

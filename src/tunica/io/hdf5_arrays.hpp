#pragma once
#include <string>
#include <vector>

#include "tunica/io/hdf5_handle.hpp"

namespace tunica::io {

/// An HDF5 file of plain arrays, for one rank. Every failure is an Error that begins with the
/// path and the dataset.
class Hdf5Reader {
public:
  explicit Hdf5Reader(const std::string& path);
  /// Attribute of the file, or of a group or dataset.
  std::string attribute(const std::string& name, const std::string& object = "/") const;
  double number(const std::string& name, const std::string& object) const;
  bool has_attribute(const std::string& name, const std::string& object) const;
  bool has(const std::string& dataset) const;
  /// Names of the members of a group.
  std::vector<std::string> names(const std::string& group) const;
  /// How many rows a dataset of so many columns has (columns 1: one-dimensional).
  std::size_t rows(const std::string& dataset, hsize_t columns = 1) const;
  /// Columns of a dataset of one or two dimensions.
  int columns(const std::string& dataset) const;
  /// A dataset of rows × columns, row by row.
  std::vector<int> integers(const std::string& dataset, hsize_t columns = 1) const;
  std::vector<double> reals(const std::string& dataset, hsize_t columns) const;
  /// Some rows of such a dataset, to where there is room for them.
  void read(const std::string& dataset, hsize_t columns, hsize_t first, hsize_t count,
            int* to) const;
  void read(const std::string& dataset, hsize_t columns, hsize_t first, hsize_t count,
            long long* to) const;
  void read(const std::string& dataset, hsize_t columns, hsize_t first, hsize_t count,
            double* to) const;
  std::vector<std::string> strings(const std::string& dataset) const;

private:
  [[noreturn]] void fail(const std::string& dataset, const std::string& message) const;
  Hdf5Handle open(const std::string& dataset) const;
  Hdf5Handle open_attribute(const std::string& name, const std::string& object) const;
  /// Number of rows; the size must fit the columns and what is stored.
  std::size_t rows_of(hid_t id, const std::string& dataset, hsize_t columns) const;
  void read_integers(const std::string& dataset, hid_t type, hsize_t columns, hsize_t first,
                     hsize_t count, void* to) const;
  void read_any(hid_t id, hid_t type, const std::string& dataset, hsize_t columns, hsize_t first,
                hsize_t count, void* to) const;

  Hdf5Silence silence_;
  std::string path_;
  Hdf5Handle file_;
};

/// Composes a file in memory, so that a full disk is noticed by us and not by HDF5, which
/// would lose its way when the library closes.
class Hdf5Writer {
public:
  /// path is where save() will put the file.
  explicit Hdf5Writer(const std::string& path);
  void attribute(const std::string& name, const std::string& value);
  /// A dataset of rows × columns, as Hdf5Reader reads it.
  void write(const std::string& dataset, const int* values, hsize_t rows, hsize_t columns = 1);
  void write(const std::string& dataset, const double* values, hsize_t rows, hsize_t columns = 1);
  void write(const std::string& dataset, const std::vector<std::string>& values);
  /// The file's bytes.
  std::string image() const;
  /// Writes the file, or throws and leaves all as it was.
  void save() const;

private:
  void write_any(const std::string& dataset, hid_t type, const void* values, hsize_t rows,
                 hsize_t columns);

  Hdf5Silence silence_;
  std::string path_;
  Hdf5Handle file_;
};

}  // namespace tunica::io

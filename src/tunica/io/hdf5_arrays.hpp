#pragma once
#include <hdf5.h>

#include <string>
#include <vector>

namespace tunica::io {

/// Owner of one HDF5 identifier.
class Hdf5Handle {
public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  hid_t id() const { return id_; }
  bool is_valid() const { return id_ >= 0; }

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

/// An HDF5 file of plain arrays, for one rank. Every failure is an Error that begins with the
/// path and the dataset.
class Hdf5Reader {
public:
  explicit Hdf5Reader(const std::string& path);
  std::string attribute(const std::string& name) const;
  bool has(const std::string& dataset) const;
  /// A dataset of rows × columns (columns 1: one-dimensional), row by row.
  std::vector<int> integers(const std::string& dataset, hsize_t columns = 1) const;
  std::vector<double> reals(const std::string& dataset, hsize_t columns) const;
  std::vector<std::string> strings(const std::string& dataset) const;

private:
  [[noreturn]] void fail(const std::string& dataset, const std::string& message) const;
  Hdf5Handle open(const std::string& dataset) const;
  /// Number of rows; the size must fit the columns and what is stored.
  std::size_t rows(hid_t id, const std::string& dataset, hsize_t columns) const;

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
  void integers(const std::string& dataset, const int* values, hsize_t rows, hsize_t columns = 1);
  void reals(const std::string& dataset, const double* values, hsize_t rows, hsize_t columns);
  void strings(const std::string& dataset, const std::vector<std::string>& values);
  /// The file's bytes.
  std::string image() const;
  /// Writes the file, or throws and leaves all as it was.
  void save() const;

private:
  void write(const std::string& dataset, hid_t type, const void* values,
             const std::vector<hsize_t>& size);

  Hdf5Silence silence_;
  std::string path_;
  Hdf5Handle file_;
};

}  // namespace tunica::io

#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/base/types.hpp"
#include "tunica/io/hdf5_handle.hpp"

namespace tunica::io {

/// The disk has no room; what is on it is as it was.
class NoRoom : public MachineFault {
public:
  using MachineFault::MachineFault;
};

/// A parallel HDF5 file, written by all ranks together. Every member is collective.
///
/// Every member ends with an agreement of the ranks and throws MachineFault on all where it has
/// failed on some, so that none goes on to what others do not come to. A rank that fails while the
/// others wait for it inside HDF5 throws after some seconds, alone: the run has to end. One rank
/// alone composes small files in memory instead, see hdf5_arrays.hpp.
class Hdf5File {
public:
  enum class Mode { create, extend };

  /// The rows of a dataset that this rank writes. One column gives a one-dimensional dataset.
  struct Rows {
    long long total;
    long long first;
    long long count;
    int columns;
  };
  /// Rows that a rank has among those of a dataset.
  struct Part {
    long long first;
    long long count;
    const double* values;
  };

  /// Throws NoRoom on all ranks if the disk has no room for the bytes to come. Room is taken
  /// beforehand because Open MPI does not return from a collective write in which one rank meets a
  /// full disk.
  Hdf5File(const std::string& path, Mode mode, long long bytes_to_come, const CommPtr& comm);
  /// Closes without a word about failures: the way out of an exception. A rank that throws alone
  /// leaves the file open: closing takes all ranks.
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Datasets of numbers that are created from now on are deflated in chunks: 1 fast to 9 small;
  /// 0: not.
  void compress(int level) { compression_ = level; }
  /// Names of what lies at the top.
  std::vector<std::string> groups();
  /// Takes a group or dataset out; its room is not used again.
  void remove(const std::string& name);
  /// Creates a group, with its parents.
  void make_group(const std::string& name);
  /// Attribute of a group or dataset.
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, long long value);
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  /// Creates a dataset (with parent groups) and writes it.
  void write(const std::string& name, const Rows& rows, const double* values);
  void write(const std::string& name, const Rows& rows, const long long* values);
  void write(const std::string& name, const Rows& rows, const int* values);
  /// Writes from several places; all ranks have the same number of parts.
  void write(const std::string& name, long long total, int columns, const std::vector<Part>& parts);
  /// Strings that all ranks know, of fixed length as Hdf5Reader reads them.
  void write(const std::string& name, const std::vector<std::string>& values);

  /// Flushes and closes.
  void close();

private:
  Hdf5Handle make_dataset(const std::string& name, long long total, int columns, hid_t type) const;
  void write_rows(hid_t dataset, const std::string& name, const Rows& rows, hid_t type,
                  const void* values) const;
  void write_any(const std::string& name, const Rows& rows, hid_t type, const void* values);
  void attribute_any(const std::string& object, const std::string& name, hid_t type,
                     const void* value);
  /// Does work of all ranks and agrees on its end.
  void together(const std::string& action, const std::function<void()>& work);
  /// Throws MachineFault, on this rank, for a negative result, which is how HDF5 fails.
  template <class Result>
  Result checked(Result result, const std::string& action) const;

  Hdf5Silence silence_;
  std::string path_;
  CommPtr comm_;
  int compression_ = 0;
  Hdf5Handle file_;  ///< closes without a word on the way out of an exception
};

}  // namespace tunica::io

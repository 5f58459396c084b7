#include "tunica/io/parallel_hdf5.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "tunica/base/agreement.hpp"
#include "tunica/base/attempt.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/exchange.hpp"
#include "tunica/io/fatal_signals.hpp"

namespace tunica::io {

namespace {

constexpr hsize_t rows_of_chunk = 16384;

/// How long file systems may take. Open MPI goes on where a rank finds no memory for what a file
/// needs, and ranks then wait for each other in different places.
constexpr unsigned patience = 600;

/// Takes room behind the end of a file, which HDF5 gives back on closing as far as it is not
/// needed; where the file system cannot say whether it has room, a write will. A failure leaves the
/// file as it was.
Outcome take_room(const std::string& path, long long bytes) {
  const int file = ::open(path.c_str(), O_WRONLY);
  if (file < 0) return Outcome::success();  // HDF5 will say why
  const off_t end = lseek(file, 0, SEEK_END);
  // Not posix_fallocate(), which writes a byte to each block where it is not supported.
  int failure = 0;
  do {
    failure = ::fallocate(file, 0, end, static_cast<off_t>(bytes)) == 0 ? 0 : errno;
  } while (failure == EINTR);
  if (failure == EOPNOTSUPP || failure == ENOSYS) failure = 0;
  const bool is_restored = failure == 0 || ftruncate(file, end) == 0;
  ::close(file);
  if (failure == 0) return Outcome::success();
  return Outcome::failure(path + ": no room for " + std::to_string(bytes) +
                          " bytes: " + std::strerror(failure) +
                          (is_restored ? "" : "; the file's end is undefined"));
}

void find_room(const std::string& path, long long bytes, const Comm& comm) {
  const Outcome room =
      agreed(comm, comm.getRank() == 0 ? take_room(path, bytes) : Outcome::success());
  if (room.is_failure()) throw NoRoom(room.reason());
}

hid_t open(const std::string& path, bool is_new, const Comm& comm) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access, mpi_comm(comm), MPI_INFO_NULL);
  H5Pset_all_coll_metadata_ops(access, true);
  H5Pset_coll_metadata_write(access, true);
  return is_new ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access)
                : H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
}

hid_t with_parents() {
  const hid_t list = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

}  // namespace

void Hdf5File::together(const std::string& action, const std::function<void()>& work) {
  const std::string doing = action + " " + path_;
  const Deadline deadline(patience, "the ranks did not end " + doing + " together within " +
                                        std::to_string(patience) + " s");
  const Outcome outcome = attempt(*comm_, doing, work);
  if (outcome.is_failure()) throw MachineFault(outcome.reason());
}

template <class Result>
Result Hdf5File::checked(Result result, const std::string& action) const {
  if (result < 0) throw MachineFault(hdf5_failure(path_, action));
  return result;
}

Hdf5File::Hdf5File(const std::string& path, Mode mode, long long bytes_to_come, const CommPtr& comm)
    : path_(path), comm_(comm), file_(H5I_INVALID_HID, H5Fclose) {
  const bool is_new = mode == Mode::create;
  if (!is_new) find_room(path, bytes_to_come, *comm);
  try {
    together(is_new ? "creating" : "opening", [&] {
      file_ = Hdf5Handle(checked(open(path, is_new, *comm), is_new ? "create" : "open"), H5Fclose);
    });
  } catch (...) {
    file_.leave_open();
    throw;
  }
}

Hdf5File::~Hdf5File() {
  if (file_.is_valid() && !all_meet(*comm_)) file_.leave_open();
}

void Hdf5File::make_group(const std::string& name) {
  together("creating a group of", [&] {
    const Hdf5Handle parents(with_parents(), H5Pclose);
    const Hdf5Handle group(
        checked(H5Gcreate2(file_, name.c_str(), parents, H5P_DEFAULT, H5P_DEFAULT),
                "create " + name),
        H5Gclose);
  });
}

std::vector<std::string> Hdf5File::groups() {
  std::vector<std::string> names;
  together("listing", [&] { checked(hdf5_names(file_, names), "list the groups"); });
  return names;
}

void Hdf5File::remove(const std::string& name) {
  together("removing a part of",
           [&] { checked(H5Ldelete(file_, name.c_str(), H5P_DEFAULT), "remove " + name); });
}

void Hdf5File::attribute(const std::string& object, const std::string& name, double value) {
  attribute_any(object, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::attribute(const std::string& object, const std::string& name, long long value) {
  attribute_any(object, name, H5T_NATIVE_LLONG, &value);
}

void Hdf5File::attribute(const std::string& object, const std::string& name,
                         const std::string& value) {
  attribute_any(object, name, hdf5_string_type(value.size()), value.c_str());
}

void Hdf5File::write(const std::string& name, const std::vector<std::string>& values) {
  const std::size_t length = hdf5_string_length(values);
  const std::vector<char> text = hdf5_text(values, length);
  const auto total = static_cast<long long>(values.size());
  write_any(name, {total, 0, comm_->getRank() == 0 ? total : 0, 1}, hdf5_string_type(length),
            text.data());
}

void Hdf5File::write(const std::string& name, const Rows& rows, const double* values) {
  write_any(name, rows, H5T_NATIVE_DOUBLE, values);
}

void Hdf5File::write(const std::string& name, const Rows& rows, const long long* values) {
  write_any(name, rows, H5T_NATIVE_LLONG, values);
}

void Hdf5File::write(const std::string& name, const Rows& rows, const int* values) {
  write_any(name, rows, H5T_NATIVE_INT, values);
}

void Hdf5File::attribute_any(const std::string& object, const std::string& name, hid_t type,
                             const void* value) {
  together("writing an attribute of", [&] {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle entry(checked(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type,
                                                     space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                   "create attribute " + name),
                           H5Aclose);
    checked(H5Awrite(entry, type, value), "write attribute " + name);
  });
}

Hdf5Handle Hdf5File::make_dataset(const std::string& name, long long total, int columns,
                                  hid_t type) const {
  const std::array<hsize_t, 2> whole{static_cast<hsize_t>(total), static_cast<hsize_t>(columns)};
  const Hdf5Handle on_disk(H5Screate_simple(columns == 1 ? 1 : 2, whole.data(), nullptr), H5Sclose);
  const Hdf5Handle parents(with_parents(), H5Pclose);
  const Hdf5Handle storage(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_fill_time(storage, H5D_FILL_TIME_NEVER);  // every row is written
  if (compression_ > 0 && total > 0) {
    const std::array<hsize_t, 2> chunk{std::min<hsize_t>(whole[0], rows_of_chunk), whole[1]};
    checked(H5Pset_chunk(storage, columns == 1 ? 1 : 2, chunk.data()), "cut " + name);
    H5Pset_shuffle(storage);
    checked(H5Pset_deflate(storage, static_cast<unsigned>(compression_)), "compress " + name);
  }
  return {checked(H5Dcreate2(file_, name.c_str(), type, on_disk, parents, storage, H5P_DEFAULT),
                  "create " + name),
          H5Dclose};
}

void Hdf5File::write_rows(hid_t dataset, const std::string& name, const Rows& rows, hid_t type,
                          const void* values) const {
  if (rows.total == 0) return;
  const int rank = rows.columns == 1 ? 1 : 2;
  const auto width = static_cast<hsize_t>(rows.columns);
  const std::array<hsize_t, 2> whole{static_cast<hsize_t>(rows.total), width};
  const std::array<hsize_t, 2> first{static_cast<hsize_t>(rows.first), 0};
  const std::array<hsize_t, 2> count{static_cast<hsize_t>(rows.count), width};
  const Hdf5Handle on_disk(H5Screate_simple(rank, whole.data(), nullptr), H5Sclose);
  const Hdf5Handle in_memory(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  if (rows.count == 0) {
    H5Sselect_none(on_disk);
    H5Sselect_none(in_memory);
  } else {
    H5Sselect_hyperslab(on_disk, H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr);
  }
  const Hdf5Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
  checked(H5Dwrite(dataset, type, in_memory, on_disk, transfer, values), "write " + name);
}

void Hdf5File::write_any(const std::string& name, const Rows& rows, hid_t type,
                         const void* values) {
  together("writing", [&] {
    const Hdf5Handle dataset = make_dataset(name, rows.total, rows.columns, type);
    write_rows(dataset, name, rows, type, values);
  });
}

void Hdf5File::write(const std::string& name, long long total, int columns,
                     const std::vector<Part>& parts) {
  together("writing", [&] {
    const Hdf5Handle dataset = make_dataset(name, total, columns, H5T_NATIVE_DOUBLE);
    for (const Part& part : parts)
      write_rows(dataset, name, {total, part.first, part.count, columns}, H5T_NATIVE_DOUBLE,
                 part.values);
  });
}

void Hdf5File::close() {
  together("closing", [this] {
    checked(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush");
    checked(file_.close(), "close");
  });
}

}  // namespace tunica::io

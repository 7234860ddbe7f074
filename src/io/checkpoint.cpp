// The HDF5 file is made in memory and written by our own code: after a failed write HDF5 1.10 can neither close the
// file nor end the program cleanly. The price is the memory of one more checkpoint or two for a moment.
#include "io/checkpoint.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <cassert>
#include <type_traits>

#include "core/errors.hpp"
#include "io/checkpoint_seal.hpp"
#include "io/file_output.hpp"

namespace knap {
namespace {

/// Owns an HDF5 identifier. A negative one means a call failed.
class Hid {
 public:
  Hid(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id_ < 0) throw RuntimeFailure("checkpoint: an HDF5 call failed");
  }
  ~Hid() { close_(id_); }
  Hid(const Hid&) = delete;
  Hid& operator=(const Hid&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): handed to HDF5 calls only

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t status) {
  if (status < 0) throw RuntimeFailure("checkpoint: an HDF5 call failed");
}

/// Keeps HDF5 from printing its error stack while it lives.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

template <class T>
hid_t hdf5_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, char>) return H5T_NATIVE_CHAR;
}

template <class Map>
void write_group(hid_t file, const char* group_name, const Map& arrays) {
  using Value = typename Map::mapped_type::value_type;
  const Hid group(H5Gcreate2(file, group_name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  const Hid with_folders(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  check(H5Pset_create_intermediate_group(with_folders, 1));
  const Hid without_times(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);  // the same content makes the same file
  check(H5Pset_obj_track_times(without_times, false));
  for (const auto& [name, values] : arrays) {
    const hsize_t size = values.size();
    const Hid space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Hid set(H5Dcreate2(group, name.c_str(), hdf5_type<Value>(), space, with_folders, without_times, H5P_DEFAULT),
                  H5Dclose);
    if (size > 0) check(H5Dwrite(set, hdf5_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  }
}

std::vector<std::string> names_of_arrays(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5O_info_t* info, void* target) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(target)->emplace_back(name);
    return 0;
  };
  check(H5Ovisit2(group, H5_INDEX_NAME, H5_ITER_NATIVE, collect, &names, H5O_INFO_BASIC));
  return names;
}

template <class Map>
void read_group(hid_t file, const char* group_name, Map& arrays) {
  using Value = typename Map::mapped_type::value_type;
  const Hid group(H5Gopen2(file, group_name, H5P_DEFAULT), H5Gclose);
  for (const std::string& name : names_of_arrays(group)) {
    const Hid set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Hid space(H5Dget_space(set), H5Sclose);
    const hssize_t size = H5Sget_simple_extent_npoints(space);
    check(size < 0 ? -1 : 0);
    auto& values = arrays[name];
    values.resize(static_cast<std::size_t>(size));
    if (size > 0) check(H5Dread(set, hdf5_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  }
}

template <class Map>
std::size_t size_in_bytes(const Map& arrays) {
  std::size_t size = 0;
  for (const auto& [name, values] : arrays) size += values.size() * sizeof(typename Map::mapped_type::value_type);
  return size;
}

/// The checkpoint as the bytes of an HDF5 file.
std::string hdf5_image(const Checkpoint& checkpoint) {
  const std::size_t content = size_in_bytes(checkpoint.doubles) + size_in_bytes(checkpoint.ints) +
                              size_in_bytes(checkpoint.bytes) + size_in_bytes(checkpoint.texts);
  const std::size_t growth = content + (1 << 20);  // all arrays and the bookkeeping of HDF5 in one allocation
  const Hid in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_fapl_core(in_memory, growth, false));
  const Hid file(H5Fcreate("checkpoint in memory", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory), H5Fclose);
  write_group(file, "doubles", checkpoint.doubles);
  write_group(file, "ints", checkpoint.ints);
  write_group(file, "bytes", checkpoint.bytes);
  write_group(file, "texts", checkpoint.texts);
  check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  check(size < 0 ? -1 : 0);
  std::string image(static_cast<std::size_t>(size), '\0');
  check(H5Fget_file_image(file, image.data(), image.size()) < 0 ? -1 : 0);
  return image;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const QuietHdf5 quiet;
  const std::string image = hdf5_image(checkpoint);
  write_parts_atomically(path, {checkpoint_seal(checkpoint.version, image), image});
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  check_checkpoint_seal(path, checkpoint_version);
  const QuietHdf5 quiet;
  Checkpoint checkpoint;
  const Hid file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  read_group(file, "doubles", checkpoint.doubles);
  read_group(file, "ints", checkpoint.ints);
  read_group(file, "bytes", checkpoint.bytes);
  read_group(file, "texts", checkpoint.texts);
  return checkpoint;
}

}  // namespace knap

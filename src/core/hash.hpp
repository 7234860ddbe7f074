#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace knap {

/// 64-bit FNV-1a over 8-byte words: order-sensitive, so equal hashes mean the same bits in the same order.
class StateHash {
 public:
  void add(std::uint64_t word);
  void add_bytes(const void* data, std::size_t size);
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(values.size());
    add_bytes(values.data(), values.size() * sizeof(T));
  }
  std::uint64_t value() const { return state_; }
  std::string hex() const;

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace knap

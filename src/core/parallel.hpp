#pragma once
// The only place with OpenMP pragmas. Every result is the same for any number of threads: work is cut into blocks whose
// bounds depend on the problem alone, each block writes only what it owns, and sums run over the blocks in order.
#include <omp.h>

#include <algorithm>
#include <vector>

#include "core/types.hpp"

namespace knap {

void set_num_threads(int n);  ///< n >= 1; 0 = all processors
int num_threads();

/// Number of blocks of `block_size` that cover n items.
inline Index num_blocks(Index n, Index block_size) { return (n + block_size - 1) / block_size; }

/// Calls body(b) for every block index b in [0, blocks), in parallel, dynamically scheduled.
template <class Body>
void parallel_blocks(Index blocks, Body&& body) {
#pragma omp parallel for schedule(dynamic, 1) if (blocks > 1)
  for (Index b = 0; b < blocks; ++b) body(b);
}

/// Calls body(i) for i in [0, n) in parallel; body(i) must write only what belongs to i.
template <class Body>
void parallel_for(Index n, Body&& body, Index block_size = 1024) {
  parallel_blocks(num_blocks(n, block_size), [&](Index b) {
    const Index end = std::min(n, (b + 1) * block_size);
    for (Index i = b * block_size; i < end; ++i) body(i);
  });
}

/// Sum of value(i) over [0, n), the same bits for any number of threads. T needs T{} and +=.
template <class T, class Value>
T ordered_sum(Index n, Value&& value, Index block_size = 1024) {
  std::vector<T> partial(at(num_blocks(n, block_size)), T{});
  parallel_blocks(to_index(partial.size()), [&](Index b) {
    const Index end = std::min(n, (b + 1) * block_size);
    T sum{};
    for (Index i = b * block_size; i < end; ++i) sum += value(i);
    partial[at(b)] = sum;
  });
  T total{};
  for (const T& part : partial) total += part;
  return total;
}

}  // namespace knap

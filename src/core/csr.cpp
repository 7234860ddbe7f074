#include "core/csr.hpp"

namespace knap {

Csr make_csr(Index num_rows, std::span<const Index> row_of_item) {
  Csr csr;
  csr.offsets.assign(at(num_rows) + 1, 0);
  for (const Index row : row_of_item)
    if (row != none) ++csr.offsets[at(row) + 1];
  for (std::size_t i = 1; i < csr.offsets.size(); ++i) csr.offsets[i] += csr.offsets[i - 1];
  csr.items.resize(at(csr.offsets.back()));
  std::vector<Index> cursor(csr.offsets.begin(), csr.offsets.end() - 1);
  for (std::size_t k = 0; k < row_of_item.size(); ++k)
    if (row_of_item[k] != none) csr.items[at(cursor[at(row_of_item[k])]++)] = to_index(k);
  return csr;
}

}  // namespace knap

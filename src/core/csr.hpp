#pragma once
#include <span>

#include "core/types.hpp"

namespace knap {

/// Compressed rows: the items of row i are items[offsets[i] .. offsets[i+1]).
struct Csr {
  std::vector<Index> offsets{0};
  std::vector<Index> items;

  Index num_rows() const { return to_index(offsets.size()) - 1; }
  std::span<const Index> operator[](Index row) const {
    return {items.data() + offsets[at(row)], items.data() + offsets[at(row) + 1]};
  }
};

/// Inverts a map: item k goes to row row_of_item[k] (none = dropped); items of a row stay in ascending order.
Csr make_csr(Index num_rows, std::span<const Index> row_of_item);

}  // namespace knap

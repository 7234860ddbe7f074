#include "fem/stiffness.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "fem/tet_reference.hpp"

namespace knap {
namespace {

constexpr Index nodes_per_block = 256;

// What the blocks of one tet are made of.
struct TangentOfTet {
  std::array<Vec3, 4> gradient;           // of the shape functions [1/m]
  std::array<Vec3, 4> cofactor_gradient;  // cof F times that [1/m]
  Mat3 F;
  double shear = 0.0;      // V mu [J]
  double slope = 0.0;      // V dU/dJ [J]
  double curvature = 0.0;  // V d2U/dJ2 [J]
};

template <class Law>
TangentOfTet tangent_of_tet(const Law& law, const TetReference& tet, const std::array<Vec3, 4>& x) {
  TangentOfTet t;
  t.gradient = shape_gradients(tet);
  t.F = deformation_gradient(tet, x[0], x[1], x[2], x[3]);
  const Mat3 cof = cofactor(t.F);
  for (std::size_t a = 0; a < 4; ++a) t.cofactor_gradient[a] = cof * t.gradient[a];
  const double J = t.F.determinant();
  t.shear = tet.volume * law.mu;
  t.slope = tet.volume * law.volumetric_slope(J);
  t.curvature = tet.volume * law.volumetric_curvature(J);
  return t;
}

// -df_a/dx_b [N/m].
Mat3 block(const TangentOfTet& t, std::size_t a, std::size_t b) {
  Mat3 k = t.curvature * t.cofactor_gradient[a] * t.cofactor_gradient[b].transpose();
  k.diagonal().array() += t.shear * t.gradient[a].dot(t.gradient[b]);
  const Vec3 w = t.slope * (t.F * t.gradient[a].cross(t.gradient[b]));
  k(0, 1) += w.z(), k(1, 0) -= w.z();
  k(1, 2) += w.x(), k(2, 1) -= w.x();
  k(2, 0) += w.y(), k(0, 2) -= w.y();
  return k;
}

// Calls visit(corner) for the corners that a node has.
template <class Visit>
void for_corners(const Topology& topology, Index node, Visit&& visit) {
  for (const Index corner : topology.corners_of_vertex[topology.vertex_of_node[at(node)]])
    if (topology.node_of_corner(corner) == node) visit(corner);
}

// The nodes from `node` on that share a tet with it, itself first, ascending.
std::vector<Index> later_neighbours(const Topology& topology, Index node) {
  std::vector<Index> nodes{node};
  for_corners(topology, node, [&](Index corner) {
    for (const Index other : topology.tet_nodes[at(corner >> 2)])
      if (other > node) nodes.push_back(other);
  });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

// The three columns of a node: where they begin, and how many blocks they have. The first block is cut to its lower
// triangle.
struct NodeColumns {
  NodeColumns(SparseMatrix& matrix, Index node) {
    const Index* outer = matrix.outerIndexPtr() + 3 * node;
    rows = matrix.innerIndexPtr() + outer[0];
    num_blocks = (outer[1] - outer[0]) / 3;
    for (int c = 0; c < 3; ++c) column[at(c)] = matrix.valuePtr() + outer[c] - c;
  }
  // Which block has the rows of `node`.
  Index find(Index node) const {
    Index low = 0, high = num_blocks;
    while (high - low > 1) {
      const Index middle = (low + high) / 2;
      (rows[3 * middle] <= 3 * node ? low : high) = middle;
    }
    return low;
  }
  void add(Index block_index, const Mat3& k) {
    for (int c = 0; c < 3; ++c)
      for (int r = block_index == 0 ? c : 0; r < 3; ++r) column[at(c)][3 * block_index + r] += k(r, c);
  }

  const Index* rows = nullptr;
  Index num_blocks = 0;
  std::array<double*, 3> column{};  // as if the first block were complete
};

template <class Law>
void update_columns(SparseMatrix& stiffness, const Topology& topology, std::span<const Vec3> reference_positions,
                    const Law& law, std::span<const Vec4> x, Index node) {
  NodeColumns columns(stiffness, node);
  for_corners(topology, node, [&](Index corner) {
    const TetCorners& nodes = topology.tet_nodes[at(corner >> 2)];
    const TetReference tet = make_tet_reference(reference_positions, topology.tet_vertices[at(corner >> 2)]);
    const TangentOfTet tangent = tangent_of_tet(
        law, tet, {xyz(x[at(nodes[0])]), xyz(x[at(nodes[1])]), xyz(x[at(nodes[2])]), xyz(x[at(nodes[3])])});
    for (std::size_t a = 0; a < 4; ++a)
      if (nodes[a] >= node) columns.add(columns.find(nodes[a]), block(tangent, a, at(corner & 3)));
  });
}

}  // namespace

SparseMatrix stiffness_pattern(const Topology& topology) {
  const Index n = topology.num_nodes();
  std::vector<std::vector<Index>> neighbours(at(n));
  parallel_for(
      n, [&](Index node) { neighbours[at(node)] = later_neighbours(topology, node); }, nodes_per_block);
  SparseMatrix pattern(3 * n, 3 * n);
  Index* outer = pattern.outerIndexPtr();
  outer[0] = 0;
  for (Index node = 0; node < n; ++node)
    for (Index c = 0; c < 3; ++c)
      outer[3 * node + c + 1] = outer[3 * node + c] + 3 * to_index(neighbours[at(node)].size()) - c;
  pattern.resizeNonZeros(outer[3 * n]);
  parallel_for(
      n,
      [&](Index node) {
        for (Index c = 0; c < 3; ++c) {
          Index* row = pattern.innerIndexPtr() + outer[3 * node + c];
          for (const Index other : neighbours[at(node)])
            for (Index r = other == node ? c : 0; r < 3; ++r) *row++ = 3 * other + r;
        }
      },
      nodes_per_block);
  pattern.coeffs().setZero();
  return pattern;
}

void update_stiffness(SparseMatrix& stiffness, const Topology& topology, std::span<const Vec3> reference_positions,
                      const Material& material, std::span<const Vec4> x) {
  stiffness.coeffs().setZero();
  std::visit(
      [&](const auto& law) {
        parallel_for(
            topology.num_nodes(),
            [&](Index node) { update_columns(stiffness, topology, reference_positions, law, x, node); },
            nodes_per_block);
      },
      material.law);
}

Eigen::VectorXd symmetric_product(const SparseMatrix& lower, const Eigen::VectorXd& u) {
  return lower.selfadjointView<Eigen::Lower>() * u;
}

}  // namespace knap

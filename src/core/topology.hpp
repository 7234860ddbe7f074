#pragma once
#include "core/csr.hpp"
#include "core/tet_mesh.hpp"

namespace knap {

enum class FacetState : std::uint8_t {
  Bonded,     ///< intact: its tets share their nodes there, as far as the cracks around allow
  Cohesive,   ///< cracked, at least one of its three corners still carries load
  Failed,     ///< no corner carries load any more; its faces still meet as twins
  HandedOver  ///< failed and displaced so far that the general contact treats its two sides
};

/// Who is joined to whom. A node is one piece of an original vertex; splitting adds nodes and changes tet_nodes, the
/// original vertices and facets never change. A corner is 4 * tet + local index.
struct Topology {
  std::vector<TetCorners> tet_nodes;     ///< current nodes
  std::vector<TetCorners> tet_vertices;  ///< original vertices
  std::vector<TetCorners> tet_facets;    ///< interior facet opposite each corner, none on the outer surface

  std::vector<std::array<Index, 2>> facet_tets;                           ///< minus and plus side
  std::vector<std::array<std::array<std::uint8_t, 2>, 3>> facet_corners;  ///< three matched local corner pairs (minus,
                                                                          ///< plus); right-hand normal: minus to plus
  std::vector<FacetState> facet_state;

  std::vector<Index> vertex_of_node;
  Csr corners_of_vertex;            ///< the vertex star: original vertex -> corners
  std::vector<Index> outer_facets;  ///< 4 * tet + local index of the opposite corner

  Index num_tets() const { return to_index(tet_nodes.size()); }
  Index num_facets() const { return to_index(facet_tets.size()); }
  Index num_nodes() const { return to_index(vertex_of_node.size()); }
  Index num_vertices() const { return corners_of_vertex.num_rows(); }

  Index node_of_corner(Index corner) const { return tet_nodes[at(corner >> 2)][at(corner & 3)]; }
  /// Current node of matched corner k (0..2) of a facet on side s (0 minus, 1 plus).
  Index facet_node(Index facet, int k, int s) const {
    return tet_nodes[at(facet_tets[at(facet)][at(s)])][facet_corners[at(facet)][at(k)][at(s)]];
  }
  Index facet_vertex(Index facet, int k) const {
    return tet_vertices[at(facet_tets[at(facet)][0])][facet_corners[at(facet)][at(k)][0]];
  }
};

/// Builds the unbroken topology; node i is vertex i. Throws InputError if more than two tets share a facet.
Topology make_topology(const TetMesh& mesh);

}  // namespace knap

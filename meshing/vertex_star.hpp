#pragma once
#include "core/csr.hpp"
#include "core/tet_mesh.hpp"

namespace knap {

/// The tets around each vertex.
Csr tets_of_vertices(const TetMesh& mesh);
/// True for the vertices of facets that belong to one tet only.
std::vector<bool> surface_vertices(const TetMesh& mesh);
/// The worst shape quality among `tets`.
double worst_shape(const TetMesh& mesh, std::span<const Index> tets);
/// The mean edge [m] that leaves `vertex`, each edge counted once a tet.
double mean_edge_at(const TetMesh& mesh, std::span<const Index> tets, Index vertex);

}  // namespace knap

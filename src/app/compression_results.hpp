#pragma once
#include <filesystem>
#include <optional>

#include "app/run_outcome.hpp"
#include "config/run_config.hpp"

namespace knap {

/// The first tool that is driven in a straight line: the one whose force and way tell the particle's strength.
std::optional<std::size_t> pressing_tool(const Simulation& s);

/// What ends the run where the case asks for it: the force of a tool has dropped.
std::optional<ForceDrop> force_drop(const RunConfig& config, const SanityCard& card, const Simulation& s);

/// The force curve of that tool from the rows of history.csv, and the strength by it; nothing without such a tool.
std::optional<Compression> compression(const Simulation& s, const RunIdentity& identity,
                                       const std::filesystem::path& history);

/// force_displacement.csv.
void write_force_displacement(const std::filesystem::path& path, const Compression& result);
/// force_displacement.png. Throws RuntimeFailure where it cannot be drawn.
void draw_force_displacement(const std::filesystem::path& png, const Compression& result, const std::string& title);

}  // namespace knap

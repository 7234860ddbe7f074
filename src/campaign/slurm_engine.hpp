#pragma once
#include <memory>

#include "campaign/engine.hpp"
#include "campaign/slurm_batch.hpp"

namespace knap {

/// Array jobs of Slurm. They outlive this process: a later one takes them over. What is started is submitted at the
/// next wait, in as few arrays as the site allows. Slurm is first asked by start or wait, which throw RuntimeFailure if
/// it does not answer then; later on they keep asking.
std::unique_ptr<Engine> make_slurm_engine(SlurmOptions options);

/// The array jobs of this campaign that may still be under way, "12, 15"; "" = none.
std::string open_slurm_jobs(const std::filesystem::path& campaign_folder);

}  // namespace knap

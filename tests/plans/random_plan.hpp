// Makes plans at random, from a seed: valid ones, of actors that take time, linger when stopped,
// compute and fail, with formulas of every operator and function; of supervisors that raise and are
// ignored; of sub-plans. For property tests.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "plan/check.hpp"

namespace vagus {

// A plan and its sub-plans by path; the outermost is "main.plan.json".
class RandomPlans final : public plan::Files {
public:
    explicit RandomPlans(uint64_t seed);
    Result<std::string> read(const std::string& path) const override;
    const std::map<std::string, std::string>& texts() const { return texts_; }

private:
    std::map<std::string, std::string> texts_;
};

}  // namespace vagus

// Debian's libasebavm, behind functions of our own: its hooks are filled in, what it sends is kept,
// and where it would abort (its assertions) it says so instead.
#pragma once

#include <cstdint>
#include <vector>

#include "machine.hpp"

namespace vagus::vm_peer {

struct PeerInsides;

class PeerVm {
public:
    PeerVm();
    ~PeerVm();
    PeerVm(const PeerVm&) = delete;
    PeerVm& operator=(const PeerVm&) = delete;

    // Each gives false if an assertion of the peer was hit; what it holds is then of no use any
    // more.
    bool receive(uint16_t type, const std::vector<uint16_t>& words);
    bool receive_event(uint16_t source, uint16_t type, const std::vector<uint16_t>& arguments);
    bool local_event(uint16_t index);
    bool run(uint16_t limit);

    State state() const;
    void set_bytecode(const std::vector<uint16_t>& bytecode);
    std::vector<Sent>& sent();

private:
    PeerInsides* insides_;
};

}  // namespace vagus::vm_peer

#include "maker.hpp"

#include <cstdlib>
#include <iterator>
#include <random>
#include <utility>

#include "isa/isa.hpp"
#include "machine.hpp"

namespace vagus::vm_peer {

namespace {

using isa::Opcode;

// Programs are made of statements that leave the stack as they find it: events first, then
// subroutines. Jumps lead to statements of the same block.
class Maker {
public:
    explicit Maker(SplitMix64& rng) : rng_(rng) {}

    std::vector<uint16_t> program() {
        make_vector();
        const size_t end = Geometry::kBytecode - 4 - below(30);
        const size_t subs_from = end - below(30);
        while (words_.size() < subs_from) statement(false);
        put(Opcode::Stop, 0);
        link_block(statements_, 0);
        const size_t first_of_subs = statements_.size();
        while (words_.size() < end) statement(true);
        put(Opcode::SubRet, 0);
        link_block({statements_.begin() + static_cast<long>(first_of_subs), statements_.end()}, 1);
        words_.resize(Geometry::kBytecode - 2);
        return words_;
    }

private:
    enum class LinkKind { Event, Jump, Branch, Call };
    struct Link {
        LinkKind kind;
        size_t at;  // of the first word
    };

    unsigned below(unsigned bound) { return static_cast<unsigned>(rng_.below(bound)); }
    bool one_in(unsigned count) { return below(count) == 0; }
    bool wild() { return one_in(400); }

    // Events 0 and 1, the first local event and the init event, each with a good chance.
    void make_vector() {
        words_.push_back(0);
        for (const uint16_t event :
             {uint16_t{0}, uint16_t{1}, isa::kLocalEventFirst, isa::kInitEvent}) {
            if (one_in(4)) continue;
            words_.push_back(event);
            links_.push_back({LinkKind::Event, words_.size()});
            words_.push_back(0);
        }
        words_[0] = static_cast<uint16_t>(wild() ? below(Geometry::kBytecode) : words_.size());
    }

    // Gives jumps and events of the block just ended a statement as target; calls are for the block
    // of subroutines.
    void link_block(const std::vector<uint16_t>& targets, int block) {
        std::vector<Link> later;
        for (const Link& link : links_) {
            if (link.kind == LinkKind::Call && block == 0) {
                later.push_back(link);
                continue;
            }
            if (targets.empty()) continue;
            const unsigned target =
                wild() ? below(0x10000) : targets[below(static_cast<unsigned>(targets.size()))];
            const unsigned distance = target - static_cast<unsigned>(link.at);
            uint16_t& word = words_[link.at];
            switch (link.kind) {
                case LinkKind::Event:
                    word = static_cast<uint16_t>(one_in(10) ? 0 : target);
                    break;
                case LinkKind::Jump:
                    word = isa::instruction(Opcode::Jump, static_cast<uint16_t>(distance));
                    break;
                case LinkKind::Branch:
                    words_[link.at + 1] = static_cast<uint16_t>(distance);
                    break;
                case LinkKind::Call:
                    word = isa::instruction(Opcode::SubCall, static_cast<uint16_t>(target));
                    break;
            }
        }
        links_ = later;
    }

    void put(Opcode opcode, unsigned argument) {
        words_.push_back(isa::instruction(opcode, static_cast<uint16_t>(argument)));
    }
    void word(unsigned value) { words_.push_back(static_cast<uint16_t>(value)); }
    unsigned address() { return wild() ? below(0x1000) : below(Geometry::kVariables); }

    void immediate() {
        if (one_in(3)) {
            put(Opcode::LargeImm, below(0x1000));
            word(make_value(rng_));
        } else {
            put(Opcode::SmallImm, one_in(2) ? below(6) : make_value(rng_));
        }
    }

    // An index for an array of `size` words: mostly inside.
    void index(unsigned size) { put(Opcode::SmallImm, one_in(40) ? below(0x1000) : below(size)); }

    // Leaves one word on the stack.
    void expression(int depth) {
        const unsigned kind = below(depth > 2 ? 5 : 10);
        if (kind < 2) {
            immediate();
        } else if (kind < 4) {
            put(Opcode::Load, address());
        } else if (kind == 4) {
            const unsigned size = wild() ? below(0x10000) : 1 + below(8);
            index(size);
            put(Opcode::LoadInd, wild() ? below(0x1000) : below(Geometry::kVariables - 8));
            word(size);
        } else if (kind == 5) {
            expression(depth + 1);
            put(Opcode::Unary, (wild() ? below(0x100) : below(3)) | below(16) << 8);
        } else {
            expression(depth + 1);
            expression(depth + 1);
            put(Opcode::Binary, binary_operator() | below(16) << 8);
        }
    }

    unsigned binary_operator() {
        if (wild()) return below(0x100);
        const unsigned code = below(isa::kBinaryOperatorCount);
        const bool divides = code == 5 || code == 6;  // fewer of them: they often end the program
        return divides && !one_in(3) ? 2 : code;
    }

    void native() {
        const unsigned id = one_in(20) ? below(0x1000) : below(2);
        if (id != kNativeCopy && id != kNativeDivide) {
            put(Opcode::Native, id);
            return;
        }
        put(Opcode::SmallImm, wild() ? below(0x1000) : below(5));
        for (unsigned i = 0; i < 2 + id; ++i) {
            put(Opcode::SmallImm, wild() ? below(0x1000) : below(Geometry::kVariables - 4));
        }
        put(Opcode::Native, id);
    }

    void statement(bool in_subroutine) {
        statements_.push_back(static_cast<uint16_t>(words_.size()));
        switch (below(20)) {
            case 0:
                put(in_subroutine ? Opcode::SubRet : Opcode::Stop, below(0x1000));
                break;
            case 1:
                native();
                break;
            case 2:
                put(Opcode::Emit, below(0x1000));
                word(wild() ? below(0x10000) : below(Geometry::kVariables - 5));
                word(wild() ? below(0x10000) : below(6));
                break;
            case 3:
                links_.push_back({LinkKind::Jump, words_.size()});
                put(Opcode::Jump, 1);
                break;
            case 4:
            case 5:
            case 6:
            case 7:
                expression(1);
                expression(1);
                links_.push_back({LinkKind::Branch, words_.size()});
                put(Opcode::Branch, binary_operator() | below(2) << 8 | (one_in(8) ? 0x200 : 0));
                word(2);
                break;
            case 8:
            case 9:
                links_.push_back({LinkKind::Call, words_.size()});
                put(Opcode::SubCall, 0);
                break;
            case 10:
            case 11:
                expression(1);
                index(8);
                put(Opcode::StoreInd, wild() ? below(0x1000) : below(Geometry::kVariables - 8));
                word(8);
                break;
            case 12:
                if (one_in(40)) word(below(0x10000));
                break;
            default:
                expression(0);
                put(Opcode::Store, address());
                break;
        }
    }

    SplitMix64& rng_;
    std::vector<uint16_t> words_;
    std::vector<uint16_t> statements_;  // where they start
    std::vector<Link> links_;           // whose targets are not known yet
};

}  // namespace

std::vector<uint16_t> make_program(SplitMix64& rng) {
    return Maker(rng).program();
}

uint16_t make_value(SplitMix64& rng) {
    static constexpr uint16_t kEdges[] = {0, 1, 0xffff, 0x7fff, 0x8000, 2, 15, 16, 31, 32};
    switch (rng.below(3)) {
        case 0:
            return kEdges[rng.below(std::size(kEdges))];
        case 1:
            return static_cast<uint16_t>(rng.below(100));
        default:
            return static_cast<uint16_t>(rng.next());
    }
}

MadeEvent make_event(SplitMix64& rng) {
    std::vector<uint16_t> arguments(rng.below(Geometry::kArguments + 3));
    for (uint16_t& argument : arguments) argument = make_value(rng);
    const uint16_t source = make_value(rng);
    return {source, static_cast<uint16_t>(rng.below(3)), std::move(arguments)};
}

uint64_t seed() {
    if (const char* given = std::getenv("VAGUS_SEED")) return std::strtoull(given, nullptr, 0);
    return std::random_device{}();
}

}  // namespace vagus::vm_peer

#include "wire/reports.hpp"

#include <string.h>

namespace vagus {
namespace wire {

namespace {

// Writes text and numbers one behind the other.
class Sentence {
public:
    explicit Sentence(char* text) : text_(text), size_(0) {}

    void add(const char* words) { add(words, static_cast<uint16_t>(strlen(words))); }
    void add(const char* bytes, uint16_t size) {
        memcpy(text_ + size_, bytes, size);
        size_ = static_cast<uint16_t>(size_ + size);
    }
    void add(int32_t number) {
        char digits[10];
        uint8_t count = 0;
        uint32_t rest =
            number < 0 ? 0u - static_cast<uint32_t>(number) : static_cast<uint32_t>(number);
        do {
            digits[count++] = static_cast<char>('0' + rest % 10);
            rest /= 10;
        } while (rest > 0);
        if (number < 0) text_[size_++] = '-';
        while (count > 0) text_[size_++] = digits[--count];
    }
    uint16_t size() const { return size_; }

private:
    char* text_;
    uint16_t size_;
};

}  // namespace

bool read_fault(const Frame& frame, Fault& fault) {
    fault = Fault{FaultKind::NodeSpecific, 0, 0, 0, Text{"", 0}};
    ArrayAccessOutOfBounds access;
    DivisionByZero division;
    EventExecutionKilled killed;
    NodeSpecificError other;
    if (decode_message(frame, access) == Error::None) {
        fault.kind = FaultKind::ArrayAccess;
        fault.pc = access.pc;
        fault.size = access.size;
        fault.index = static_cast<int16_t>(access.index);
        return true;
    }
    if (decode_message(frame, division) == Error::None) {
        fault.kind = FaultKind::DivisionByZero;
        fault.pc = division.pc;
        return true;
    }
    if (decode_message(frame, killed) == Error::None) {
        fault.kind = FaultKind::Killed;
        fault.pc = killed.pc;
        return true;
    }
    if (decode_message(frame, other) != Error::None) return false;
    fault.pc = other.pc;
    fault.text = other.text;
    return true;
}

uint16_t write_fault_text(const Fault& fault, char* text) {
    Sentence sentence(text);
    switch (fault.kind) {
        case FaultKind::ArrayAccess:
            sentence.add("array access out of bounds");
            if (fault.size == 0) break;
            sentence.add(": index ");
            sentence.add(fault.index);
            sentence.add(" in an array of ");
            sentence.add(fault.size);
            break;
        case FaultKind::DivisionByZero:
            sentence.add("division by zero");
            break;
        case FaultKind::Killed:
            sentence.add("the event was still being worked on when the next one came");
            break;
        case FaultKind::NodeSpecific:
            sentence.add(fault.text.bytes, fault.text.size);
            break;
    }
    return sentence.size();
}

}  // namespace wire
}  // namespace vagus

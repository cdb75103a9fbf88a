#include "wire/line_reader.hpp"

#include <string.h>

namespace vagus {
namespace wire {

namespace {

constexpr uint8_t kGoodMin = 2;      // good headers in a row are sure to be a boundary …
constexpr uint8_t kPossibleMin = 4;  // … so many that are only possible are likely one

uint16_t word_at(const uint8_t* bytes) {
    return static_cast<uint16_t>(bytes[0] | (bytes[1] << 8));
}

struct Sizes {
    uint16_t least;
    uint16_t most;
};

// Of the payload, by the fields of each message (docs/spec, section 2), if it has one size.
Sizes one_size_of(uint16_t type) {
    switch (static_cast<MessageType>(type)) {
        case MessageType::Disconnected:
            return {0, 0};
        case MessageType::NodePresent:
        case MessageType::DivisionByZero:
        case MessageType::EventExecutionKilled:
        case MessageType::GetDescription:
        case MessageType::ListNodes:
        case MessageType::Reset:
        case MessageType::Run:
        case MessageType::Pause:
        case MessageType::Step:
        case MessageType::Stop:
        case MessageType::GetExecutionState:
        case MessageType::BreakpointClearAll:
        case MessageType::WriteBytecode:
        case MessageType::Reboot:
        case MessageType::SuspendToRam:
        case MessageType::GetChangedVariables:
        case MessageType::BootloaderReset:
            return {2, 2};
        case MessageType::ExecutionStateChanged:
        case MessageType::BreakpointSetResult:
        case MessageType::BreakpointSet:
        case MessageType::BreakpointClear:
        case MessageType::GetNodeDescription:
        case MessageType::GetDeviceInfo:
        case MessageType::BootloaderReadPage:
        case MessageType::BootloaderWritePage:
            return {4, 4};
        case MessageType::GetVariables:
        case MessageType::GetNodeDescriptionFragment:
        case MessageType::BootloaderDescription:
            return {6, 6};
        default:  // types are numbers from outside: they have several sizes, or are not known
            return {1, 0};
    }
}

// Nothing fits a type that is not there.
Sizes sizes_of(uint16_t type) {
    const Sizes one = one_size_of(type);
    if (one.least == one.most) return one;
    switch (static_cast<MessageType>(type)) {
        case MessageType::ArrayAccessOutOfBounds:
            return {2, 6};
        case MessageType::BootloaderAck:
            return {2, 4};
        case MessageType::Description:
            return {15, 15 + 255};
        case MessageType::NamedVariableDescription:
        case MessageType::NodeSpecificError:
            return {3, 3 + 255};
        case MessageType::LocalEventDescription:
            return {2, 2 + 2 * 255};
        case MessageType::NativeFunctionDescription:
            return {4, kPayloadMax};
        case MessageType::Variables:
        case MessageType::DeviceInfo:
        case MessageType::BootloaderPageDataWrite:
            return {2, kPayloadMax};
        case MessageType::SetBytecode:
        case MessageType::SetVariables:
            return {4, kPayloadMax};
        case MessageType::SetDeviceInfo:
            return {6, kPayloadMax};
        case MessageType::ChangedVariables:
        case MessageType::BootloaderPageDataRead:
            return {0, kPayloadMax};
        default:  // see above
            return {1, 0};
    }
}

bool is_sent_by_nodes(uint16_t type) {
    return (type >= 0x8004 && type <= 0x8006) || (type >= 0x9000 && type < 0xa000);
}

// Of the sieve: the upper nine bits, into which all bits of the source have gone.
uint16_t bit_of(uint16_t source) {
    return static_cast<uint16_t>(static_cast<uint16_t>(source * 40503u) >> 7);
}

// Six zeros look like event 0 of a host, are inside of many frames, and are what a broken line
// sends.
bool is_zero(const uint8_t* header) {
    for (uint16_t i = 0; i < kHeaderSize; ++i) {
        if (header[i] != 0) return false;
    }
    return true;
}

}  // namespace

LineReader::LineReader(uint32_t frame_within_ms)
    : have_(0),
      lost_(false),
      quiet_(false),
      overdue_(false),
      within_ms_(frame_within_ms),
      began_ms_(0),
      last_ms_(0),
      skipped_(0) {
    memset(heard_, 0, sizeof heard_);
}

uint16_t LineReader::feed(const uint8_t* bytes, uint16_t size, uint32_t now_ms) {
    const uint16_t room = static_cast<uint16_t>(kLineBufferMax - have_);
    const uint16_t taken = size < room ? size : room;
    if (taken == 0) return 0;
    if (have_ == 0) began_ms_ = now_ms;
    memcpy(buffer_ + have_, bytes, taken);
    have_ = static_cast<uint16_t>(have_ + taken);
    last_ms_ = now_ms;
    quiet_ = false;
    return taken;
}

void LineReader::tick(uint32_t now_ms) {
    if (have_ == 0) return;
    quiet_ = now_ms - last_ms_ >= kLineQuiet_ms;
    overdue_ = !lost_ && now_ms - began_ms_ >= within_ms_;
}

bool LineReader::next(Frame& frame) {
    for (;;) {
        if (lost_ && !find_boundary()) return false;
        if (have_ < kHeaderSize && !quiet_ && !overdue_) return false;
        if (have_ == 0) return false;
        const Header header = have_ < kHeaderSize ? Header::Impossible : judge(0);
        if (header == Header::Impossible) {
            lose();
            continue;
        }
        const uint16_t size = static_cast<uint16_t>(kHeaderSize + word_at(buffer_));
        if (!is_whole(header, size)) {
            if (lost_) continue;
            return false;
        }
        frame.size = word_at(buffer_);
        frame.source = word_at(buffer_ + 2);
        frame.type = word_at(buffer_ + 4);
        memcpy(frame.payload, buffer_ + kHeaderSize, frame.size);
        if (header == Header::Good && !is_user_event(frame.type)) hear(frame.source);
        remove(size);
        return true;
    }
}

// Is the frame in front there, and its witness if it needs one? May find that it is none.
bool LineReader::is_whole(Header header, uint16_t size) {
    if (have_ < size) {
        const bool is_none = header == Header::Doubtful && is_sure_behind();
        if (quiet_ || overdue_ || is_none) lose();
        return false;
    }
    if (header == Header::Good) return true;
    if (have_ >= size + kHeaderSize) {
        if (judge(size) != Header::Impossible) return true;
        lose();
        return false;
    }
    if (!quiet_) return false;
    if (have_ == size) return true;
    lose();
    return false;
}

LineReader::Header LineReader::judge(uint16_t at) const {
    const uint8_t* const header = buffer_ + at;
    const uint16_t size = word_at(header);
    const uint16_t source = word_at(header + 2);
    const uint16_t type = word_at(header + 4);
    if (size > kPayloadMax || source == kInvalidId || type == 0xffff) return Header::Impossible;
    if (is_user_event(type)) {
        if (size % 2 != 0) return Header::Impossible;
        if (is_heard(source)) return Header::Good;
        return is_zero(header) ? Header::Impossible : Header::Doubtful;
    }
    const Sizes sizes = sizes_of(type);
    if (sizes.least > sizes.most) return Header::Doubtful;  // a type that we do not know
    if (size < sizes.least || size > sizes.most) return Header::Impossible;
    const bool fits = is_sent_by_nodes(type) ? source != kHostId : source == kHostId;
    return fits ? Header::Good : Header::Doubtful;
}

// Could a frame begin here, by it and those behind it?
LineReader::Chain LineReader::follow(uint16_t at) const {
    uint8_t headers = 0;
    uint8_t good = 0;
    while (at + kHeaderSize <= have_) {
        const Header header = judge(at);
        if (header == Header::Impossible) return Chain::Broken;
        const bool zero = is_zero(buffer_ + at);
        if (zero && headers == 0) return Chain::Broken;
        ++headers;
        if (header == Header::Good && !zero) ++good;
        if (good >= kGoodMin) return Chain::Sure;
        if (headers >= kPossibleMin) return Chain::Likely;
        at = static_cast<uint16_t>(at + kHeaderSize + word_at(buffer_ + at));
        if (at == have_ && quiet_) return Chain::Likely;
        if (at >= have_) break;
    }
    return quiet_ ? Chain::Broken : Chain::Open;  // a piece of a frame, and nothing follows?
}

// While a doubtful frame is awaited: are there surely others where its payload would be?
bool LineReader::is_sure_behind() const {
    for (uint16_t at = 1; at < have_; ++at) {
        if (follow(at) == Chain::Sure) return true;
    }
    return false;
}

// Skips to the first place that is certain. Without one it keeps what may still become one.
bool LineReader::find_boundary() {
    uint16_t open = have_;
    for (uint16_t at = 0; at < have_; ++at) {
        const Chain chain = follow(at);
        if (chain == Chain::Sure || chain == Chain::Likely) {
            skip(at);
            lost_ = false;
            return true;
        }
        if (chain == Chain::Open && open == have_) open = at;
    }
    if (quiet_) {  // the next byte begins a frame, as after every silence
        skip(have_);
        lost_ = false;
    } else if (have_ == kLineBufferMax) {
        skip(open > 0 ? open : 1);
    }
    return false;
}

void LineReader::lose() {
    skip(1);
    lost_ = true;
    overdue_ = false;
}

void LineReader::skip(uint16_t count) {
    skipped_ += count;
    remove(count);
}

void LineReader::remove(uint16_t count) {
    have_ = static_cast<uint16_t>(have_ - count);
    memmove(buffer_, buffer_ + count, have_);
    began_ms_ = last_ms_;
    overdue_ = false;
}

// Only what is said in messages of section 2 counts: an event may be anything. A source that was
// not heard may pass for one that was, once in a while.
bool LineReader::is_heard(uint16_t source) const {
    const uint16_t bit = bit_of(source);
    return (heard_[bit / 8] >> (bit % 8) & 1) != 0;
}

void LineReader::hear(uint16_t source) {
    const uint16_t bit = bit_of(source);
    heard_[bit / 8] = static_cast<uint8_t>(heard_[bit / 8] | (1 << (bit % 8)));
}

}  // namespace wire
}  // namespace vagus

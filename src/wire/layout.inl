// The layouts of messages.hpp, each written once. A stream has the same verbs whether it reads or
// writes. Included by messages.hpp only.

namespace vagus {
namespace wire {

class DecodeStream {
public:
    DecodeStream(const uint8_t* bytes, uint16_t size)
        : reader_(bytes, size), end_(bytes + size), too_long_(false) {}

    void u8(uint8_t& value) { value = reader_.u8(); }
    void u16(uint16_t& value) { value = reader_.u16(); }
    void i16(int16_t& value) { value = reader_.i16(); }
    void text(Text& value) { value = reader_.text(); }
    // A list's count, cut to `limit` so that the loop that follows stays inside its array.
    void count(uint16_t& value, uint16_t limit) {
        value = reader_.u16();
        if (value <= limit) return;
        too_long_ = true;
        value = 0;
    }
    void words(Words& value) {
        value.count = static_cast<uint16_t>(reader_.left() / 2);
        for (uint16_t i = 0; i < value.count; ++i) value.values[i] = reader_.i16();
        if (reader_.left() == 1) reader_.u8();
    }
    void bytes(Bytes& value) {
        value.size = reader_.left();
        value.bytes = end_ - value.size;
        while (reader_.left() > 0) reader_.u8();
    }
    bool at_end() const { return reader_.left() == 0; }
    Error finish() const {
        if (too_long_) return Error::TooLong;
        if (reader_.failed()) return Error::Truncated;
        return reader_.left() > 0 ? Error::TrailingBytes : Error::None;
    }

private:
    Reader reader_;
    const uint8_t* end_;
    bool too_long_;
};

class EncodeStream {
public:
    EncodeStream(uint8_t* bytes, uint16_t capacity) : writer_(bytes, capacity), too_long_(false) {}

    void u8(const uint8_t& value) { writer_.u8(value); }
    void u16(const uint16_t& value) { writer_.u16(value); }
    void i16(const int16_t& value) { writer_.i16(value); }
    void text(const Text& value) { writer_.text(value); }
    void count(const uint16_t& value, uint16_t limit) {
        too_long_ = too_long_ || value > limit;
        writer_.u16(value);
    }
    void words(const Words& value) {
        too_long_ = too_long_ || value.count > kArgumentsMax;
        for (uint16_t i = 0; !too_long_ && i < value.count; ++i) writer_.i16(value.values[i]);
    }
    void bytes(const Bytes& value) {
        for (uint16_t i = 0; i < value.size; ++i) writer_.u8(value.bytes[i]);
    }
    bool at_end() const { return false; }
    bool too_long() const { return too_long_ || writer_.failed(); }
    uint16_t size() const { return writer_.size(); }

private:
    Writer writer_;
    bool too_long_;
};

// `Message` is const when writing; that is all that tells the two apart here.
#define VAGUS_LAYOUT(name)                                                       \
    template <typename Stream>                                                   \
    void layout_fields(Stream& s, name& m);                                      \
    template <typename Stream>                                                   \
    void layout(Stream& s, const name& m) {                                      \
        layout_fields(s, const_cast<name&>(m)); /* an EncodeStream only reads */ \
    }                                                                            \
    template <typename Stream>                                                   \
    void layout_fields(Stream& s, name& m)

VAGUS_LAYOUT(Description) {
    s.text(m.name);
    s.u16(m.protocol_version);
    s.u16(m.bytecode_size);
    s.u16(m.stack_size);
    s.u16(m.variables_size);
    s.u16(m.variable_count);
    s.u16(m.local_event_count);
    s.u16(m.native_count);
}
VAGUS_LAYOUT(NamedVariableDescription) {
    s.u16(m.size);
    s.text(m.name);
}
VAGUS_LAYOUT(LocalEventDescription) {
    s.text(m.name);
    s.text(m.doc);
}
VAGUS_LAYOUT(NativeFunctionDescription) {
    s.text(m.name);
    s.text(m.doc);
    s.count(m.parameter_count, kParametersMax);
    for (uint16_t i = 0; i < m.parameter_count; ++i) {
        s.i16(m.parameters[i].size);
        s.text(m.parameters[i].name);
    }
}
VAGUS_LAYOUT(Disconnected) {
    (void)s;
    (void)m;
}
VAGUS_LAYOUT(Variables) {
    s.u16(m.start);
    s.words(m.values);
}
VAGUS_LAYOUT(ArrayAccessOutOfBounds) {
    s.u16(m.pc);
    if (s.at_end()) {
        m.size = m.index = 0;
        return;
    }
    s.u16(m.size);
    s.u16(m.index);
}
VAGUS_LAYOUT(DivisionByZero) {
    s.u16(m.pc);
}
VAGUS_LAYOUT(EventExecutionKilled) {
    s.u16(m.pc);
}
VAGUS_LAYOUT(NodeSpecificError) {
    s.u16(m.pc);
    s.text(m.text);
}
VAGUS_LAYOUT(ExecutionStateChanged) {
    s.u16(m.pc);
    s.u16(m.flags);
}
VAGUS_LAYOUT(BreakpointSetResult) {
    s.u16(m.pc);
    s.u16(m.success);
}
VAGUS_LAYOUT(NodePresent) {
    s.u16(m.version);
}
VAGUS_LAYOUT(DeviceInfo) {
    s.u8(m.info);
    s.text(m.value);
}
VAGUS_LAYOUT(ChangedVariables) {
    s.bytes(m.areas);
}
VAGUS_LAYOUT(GetDescription) {
    s.u16(m.version);
}
VAGUS_LAYOUT(ListNodes) {
    s.u16(m.version);
}

#define VAGUS_COMMAND_LAYOUT(name) \
    VAGUS_LAYOUT(name) {           \
        s.u16(m.dest);             \
    }
VAGUS_COMMAND_LAYOUT(Reset)
VAGUS_COMMAND_LAYOUT(Run)
VAGUS_COMMAND_LAYOUT(Pause)
VAGUS_COMMAND_LAYOUT(Step)
VAGUS_COMMAND_LAYOUT(Stop)
VAGUS_COMMAND_LAYOUT(GetExecutionState)
VAGUS_COMMAND_LAYOUT(BreakpointClearAll)
VAGUS_COMMAND_LAYOUT(WriteBytecode)
VAGUS_COMMAND_LAYOUT(Reboot)
VAGUS_COMMAND_LAYOUT(SuspendToRam)
VAGUS_COMMAND_LAYOUT(GetChangedVariables)
VAGUS_COMMAND_LAYOUT(BootloaderReset)
#undef VAGUS_COMMAND_LAYOUT

VAGUS_LAYOUT(SetBytecode) {
    s.u16(m.dest);
    s.u16(m.start);
    s.words(m.words);
}
VAGUS_LAYOUT(BreakpointSet) {
    s.u16(m.dest);
    s.u16(m.pc);
}
VAGUS_LAYOUT(BreakpointClear) {
    s.u16(m.dest);
    s.u16(m.pc);
}
VAGUS_LAYOUT(GetVariables) {
    s.u16(m.dest);
    s.u16(m.start);
    s.u16(m.length);
}
VAGUS_LAYOUT(SetVariables) {
    s.u16(m.dest);
    s.u16(m.start);
    s.words(m.values);
}
VAGUS_LAYOUT(GetNodeDescription) {
    s.u16(m.dest);
    s.u16(m.version);
}
VAGUS_LAYOUT(GetDeviceInfo) {
    s.u16(m.dest);
    s.u16(m.info);
}
VAGUS_LAYOUT(SetDeviceInfo) {
    s.u16(m.dest);
    s.u16(m.info);
    s.u16(m.size);
    s.bytes(m.value);
}
VAGUS_LAYOUT(GetNodeDescriptionFragment) {
    s.u16(m.dest);
    s.u16(m.version);
    s.i16(m.fragment);
}
VAGUS_LAYOUT(BootloaderReadPage) {
    s.u16(m.dest);
    s.u16(m.page);
}
VAGUS_LAYOUT(BootloaderWritePage) {
    s.u16(m.dest);
    s.u16(m.page);
}
VAGUS_LAYOUT(BootloaderPageDataWrite) {
    s.u16(m.dest);
    s.bytes(m.bytes);
}
VAGUS_LAYOUT(BootloaderDescription) {
    s.u16(m.page_size);
    s.u16(m.first_page);
    s.u16(m.page_count);
}
VAGUS_LAYOUT(BootloaderPageDataRead) {
    s.bytes(m.bytes);
}
VAGUS_LAYOUT(BootloaderAck) {
    s.u16(m.error);
    if (s.at_end()) {
        m.address = 0;
        return;
    }
    s.u16(m.address);
}
#undef VAGUS_LAYOUT

template <typename Message>
Error decode_message(const Frame& frame, Message& message) {
    if (frame.type != static_cast<uint16_t>(Message::kType)) return Error::WrongType;
    DecodeStream stream(frame.payload, frame.size);
    layout_fields(stream, message);
    return stream.finish();
}

template <typename Message>
Error encode_message(const Message& message, uint16_t source, Frame& frame) {
    EncodeStream stream(frame.payload, kPayloadMax);
    layout(stream, message);
    if (stream.too_long()) return Error::TooLong;
    frame.source = source;
    frame.type = static_cast<uint16_t>(Message::kType);
    frame.size = stream.size();
    return Error::None;
}

}  // namespace wire
}  // namespace vagus

#include "session/software_node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/natives.hpp"
#include "wire/messages.hpp"

namespace vagus::session {
namespace {

using testing::HasSubstr;

aesl::Target small_target() {
    aesl::Target target;
    target.name = "small";
    target.bytecode_size = 32;
    target.variables_size = 20;
    target.stack_size = 8;
    target.variables = {{"id", 1}, {"event.source", 1}, {"event.args", 2}, {"speed", 3}};
    target.local_events = {{"timer", ""}, {"bump", "touched"}};
    return target;
}

aesl::NativeFunction sum_of(int16_t size) {
    return {"sys.sum", "", {{"dest", 1}, {"src", size}}};
}

std::string refusal(aesl::Target target) {
    const auto made = SoftwareNode::make(std::move(target), {});
    return made.ok() ? "" : made.error().what;
}

TEST(SoftwareNode, HasTheMemoriesOfItsTarget) {
    const auto made = SoftwareNode::make(small_target(), {.id = 7});
    ASSERT_TRUE(made.ok());
    SoftwareNode& node = *made.value();
    EXPECT_EQ(node.id(), 7);
    EXPECT_EQ(node.variables().size(), 20u);
    EXPECT_EQ(node.bytecode().size(), 32u);
    EXPECT_EQ(node.find_variable("speed")->address, 4);
    EXPECT_EQ(node.find_variable("speed")->size, 3);
    EXPECT_EQ(node.find_variable("none"), std::nullopt);
    EXPECT_EQ(node.find_local_event("bump"), 1);
    EXPECT_EQ(node.find_local_event("none"), std::nullopt);
}

TEST(SoftwareNode, KeepsAsManyArgumentsAsItsThirdVariableHasWords) {
    const auto made = SoftwareNode::make(small_target(), {});
    SoftwareNode& node = *made.value();
    wire::Frame frame{.size = 6, .source = 9, .type = 0, .payload = {1, 0, 2, 0, 3, 0}};
    node.receive(frame);
    EXPECT_THAT(node.variables().first(5), testing::ElementsAre(0, 9, 1, 2, 0));
}

TEST(SoftwareNode, DescribesItselfWithTheTextsOfItsTarget) {
    std::vector<wire::Frame> sent;
    aesl::Target target = small_target();
    target.natives = {sum_of(0)};
    const auto made = SoftwareNode::make(
        std::move(target),
        {.id = 7, .transmit = [&sent](const wire::Frame& f) { sent.push_back(f); }});
    wire::GetNodeDescription question;
    question.dest = 7;
    question.version = 5;
    wire::Frame ask;
    ASSERT_EQ(wire::encode_message(question, wire::kHostId, ask), wire::Error::None);
    made.value()->receive(ask);
    ASSERT_EQ(sent.size(), 1u + 4 + 2 + 1);
    wire::Description header;
    ASSERT_EQ(wire::decode_message(sent[0], header), wire::Error::None);
    EXPECT_EQ(std::string(header.name.bytes, header.name.size), "small");
    EXPECT_EQ(header.variables_size, 20);
    wire::NativeFunctionDescription native;
    ASSERT_EQ(wire::decode_message(sent[7], native), wire::Error::None);
    EXPECT_EQ(std::string(native.name.bytes, native.name.size), "sys.sum");
    EXPECT_EQ(native.parameters[1].size, 0);
}

TEST(SoftwareNode, FindsTheCodeOfNativesByNameWhateverTheirOrder) {
    aesl::Target target = small_target();
    target.natives = {sum_of(0), {"math.fill", "", {{"dest", -1}, {"value", 1}}}};
    const auto made = SoftwareNode::make(std::move(target), {});
    SoftwareNode& node = *made.value();
    // 5 into 4..6 (native 1: length 3, value at 10), then the sum of 4..6 to 11 (native 0).
    const uint16_t program[] = {3,      0xffff, 3,      0x1003, 0x100a, 0x1004,
                                0xc001, 0x1003, 0x1004, 0x100b, 0xc000, 0};
    ASSERT_TRUE(node.load(program).ok());
    node.variables()[10] = 5;
    ASSERT_TRUE(node.start_event(0xffff));
    node.run(100);
    EXPECT_EQ(node.variables()[11], 15);
    EXPECT_FALSE(node.is_active());
}

TEST(SoftwareNode, NativeWithoutCodeIsRefusedByName) {
    aesl::Target target = small_target();
    target.natives = {{"sound.play", "", {{"number", 1}}}};
    EXPECT_THAT(refusal(target), HasSubstr("native sound.play has no code"));
}

TEST(SoftwareNode, NativeWithOtherParametersThanItsCodeIsRefused) {
    aesl::Target target = small_target();
    target.natives = {sum_of(3)};  // no length would be pushed
    EXPECT_THAT(refusal(target), HasSubstr("sys.sum takes 3 words"));
}

TEST(SoftwareNode, EveryStandardNativeIsAcceptedAsItDescribesItself) {
    aesl::Target target = small_target();
    for (const node::Native& native : node::kStandardNatives) {
        aesl::NativeFunction declared{native.name, native.doc, {}};
        for (uint16_t i = 0; i < native.parameter_count; ++i) {
            declared.parameters.push_back({native.parameters[i].name, native.parameters[i].size});
        }
        target.natives.push_back(declared);
    }
    target.natives.push_back({"sys.nop", "", {}});
    EXPECT_EQ(refusal(target), "");
}

TEST(SoftwareNode, VariablesMustFitTheMemory) {
    aesl::Target target = small_target();
    target.variables_size = 7;
    EXPECT_EQ(refusal(target), "");
    target.variables_size = 6;
    EXPECT_THAT(refusal(target), HasSubstr("7 words, but has memory for 6"));
}

TEST(SoftwareNode, WithoutBytecodeMemoryItIsRefused) {
    aesl::Target target = small_target();
    target.bytecode_size = 0;
    EXPECT_THAT(refusal(target), HasSubstr("no bytecode memory"));
}

TEST(SoftwareNode, ProgramMustFitAndReplacesTheOneBefore) {
    const auto made = SoftwareNode::make(small_target(), {});
    SoftwareNode& node = *made.value();
    EXPECT_TRUE(node.load(std::vector<uint16_t>(32, 7)).ok());
    EXPECT_FALSE(node.load(std::vector<uint16_t>(33, 7)).ok());
    EXPECT_TRUE(node.load(std::vector<uint16_t>{1}).ok());
    EXPECT_EQ(node.bytecode()[0], 1);
    EXPECT_EQ(node.bytecode()[1], 0);
}

}  // namespace
}  // namespace vagus::session

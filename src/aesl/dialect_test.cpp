// The dialect of 2007 (docs/spec/aesl-language.md, section 6).
#include "aesl/test_node.hpp"

namespace vagus::aesl {
namespace {

constexpr std::string_view kListing =
    "# declare and initialize variables\n"
    "var bumperLimit = 10\n"
    "var bumperFilter[4] = 0, 0, 0\n"
    "# to execute periodically\n"
    "ontimer:\n"
    "# call native function meanFilter\n"
    "call meanFilter(bumper, bumperFilter)\n"
    "# when conditional\n"
    "when bumper > bumperLimit do\n"
    "    # send event with variable bumper\n"
    "   emit ObstacleDetected bumper\n"
    "end\n"
    "# to execute on event SetLimit\n"
    "onevent SetLimit:\n"
    "# args contains the arguments of events\n"
    "bumperLimit = args[0]\n";

Target paper_node() {
    Target target;
    target.name = "paper";
    target.bytecode_size = 600;
    target.variables_size = 200;
    target.stack_size = 32;
    target.variables = {{"id", 1}, {"event.source", 1}, {"event.args", 32}, {"bumper", 1}};
    target.local_events = {{"timer", ""}};
    target.natives = {{"meanFilter", "", {{"value", 1}, {"filter", 4}}}};
    return target;
}

const CommonDefinitions kSized{.events = {{"ObstacleDetected", 1}, {"SetLimit", 1}},
                               .constants = {}};
const CommonDefinitions kUnsized{
    .events = {{"ObstacleDetected", std::nullopt}, {"SetLimit", std::nullopt}}, .constants = {}};

// The words at the end of section 6.
const std::vector<uint16_t> kWords = {
    0x0007, 0x0001, 0x0007, 0xfffe, 0x000a, 0xffff, 0x0016, 0x3002, 0x4023, 0x0000, 0x1004,
    0x1024, 0x1022, 0xc000, 0x3022, 0x3023, 0xa10c, 0x0005, 0xb000, 0x0022, 0x0001, 0x0000,
    0x100a, 0x4023, 0x1000, 0x4024, 0x1000, 0x4025, 0x1000, 0x4026, 0x1000, 0x4027, 0x0000};

TEST(Dialect, TheListingOfThePaperGivesTheWordsOfTheSpecification) {
    // The specification's native takes any array, so that its size is pushed.
    Target target = paper_node();
    target.natives[0].parameters[1].size = -1;
    for (const CommonDefinitions& common : {kSized, kUnsized}) {
        const Compilation done = compile(kListing, target, common, {});
        ASSERT_TRUE(done.ok()) << done.errors[0].message;
        EXPECT_EQ(done.program.bytecode, kWords);
        EXPECT_TRUE(done.warnings.empty());
    }
    const Compilation asked =
        compile(kListing, target, kSized, {.dialect = Dialect::Year2007, .ontimer = ""});
    EXPECT_EQ(asked.program.bytecode, kWords);
}

TEST(Dialect, ModernRefusesWhatThePaperWrites) {
    const Compilation done =
        compile(kListing, paper_node(), kSized, {.dialect = Dialect::Modern, .ontimer = ""});
    List found;
    for (const Diagnostic& d : done.errors)
        found.push_back(std::to_string(d.at.line) + " " + d.code);
    EXPECT_EQ(found, (List{"3 ARRAY_SIZE_MISMATCH", "5 VARIABLE_NOT_DEFINED", "14 EXPECTING",
                           "16 VARIABLE_NOT_DEFINED"}));
}

std::string handler_of(const std::vector<std::string>& events, const std::string& option) {
    Target target = paper_node();
    target.local_events.clear();
    for (const std::string& event : events) target.local_events.push_back({event, ""});
    const Compilation done =
        compile("ontimer\nid = 1", target, kSized, {.dialect = Dialect::Auto, .ontimer = option});
    if (!done.ok()) return done.errors[0].code;
    const int k = 0xfffe - done.program.bytecode[1];
    return events[static_cast<size_t>(k)];
}

TEST(Dialect, OntimerIsTheOptionOrAKnownNameOrTheOnlyEvent) {
    EXPECT_EQ(handler_of({"a", "timer0", "timer", "ontimer"}, ""), "ontimer");
    EXPECT_EQ(handler_of({"a", "timer0", "timer"}, ""), "timer");
    EXPECT_EQ(handler_of({"a", "timer0"}, ""), "timer0");
    EXPECT_EQ(handler_of({"beat"}, ""), "beat");
    EXPECT_EQ(handler_of({"a", "timer"}, "a"), "a");
    EXPECT_EQ(handler_of({"a", "b"}, ""), "EVENT_NOT_DEFINED");
    EXPECT_EQ(handler_of({"a", "timer"}, "none"), "EVENT_NOT_DEFINED");
}

List errors_in(std::string_view source) {
    List found;
    const Compilation done = compile(source, paper_node(), kSized, {});
    for (const Diagnostic& d : done.errors) {
        found.push_back(std::to_string(d.at.line) + ":" + std::to_string(d.at.column) + " " +
                        d.code);
    }
    return found;
}

TEST(Dialect, OntimerIsAnOrdinaryNameInModernPrograms) {
    EXPECT_EQ(errors_in("var ontimer = 3\nontimer = 4\nid = ontimer\n"), List{});
    EXPECT_EQ(errors_in("var a[4]\nconst ontimer = 1\n"), (List{"2:1 EXPECTING"}));
    EXPECT_EQ(errors_in("const ontimer = 1\nvar a[4]\na[ontimer:3] = [1,2,3]\nid = 2\n"), List{});
    EXPECT_EQ(errors_in("const ontimer = 1\nfor id in ontimer:9 do end\n"), List{});
    EXPECT_EQ(errors_in("callsub ontimer\nsub ontimer\nid = 1\n"), List{});
    // No sign of 2007 here, so a list must not be short.
    EXPECT_EQ(errors_in("var a[4] = 1, 2\nsub ontimer\nid = 1\n"),
              (List{"1:10 ARRAY_SIZE_MISMATCH"}));
    // A colon makes it a header although a variable has the name.
    EXPECT_EQ(errors_in("var ontimer = 3\nontimer:\nid = ontimer\n"), List{});
}

TEST(Dialect, ASecondHandlerForTheSameEventIsAnError) {
    EXPECT_EQ(errors_in("ontimer:\nid = 1\nonevent timer\nid = 2"),
              (List{"3:9 EVENT_ALREADY_IMPL"}));
    EXPECT_EQ(errors_in("onevent timer:\nid = 1\nontimer\nid = 2"),
              (List{"3:1 EVENT_ALREADY_IMPL"}));
}

TEST(Dialect, AShortListIsFilledWithZerosAndALongOneIsNot) {
    EXPECT_EQ(errors_in("var a[4] = 1, 2\nvar b[3] = 7\nvar c[3] = [1, 2]\nontimer:\nid = 1"),
              List{});
    EXPECT_EQ(errors_in("var a[2] = 1, 2, 3\nontimer:\nid = 1"),
              (List{"1:10 ARRAY_SIZE_MISMATCH"}));
    EXPECT_EQ(errors_in("var a[2]\nvar b[3] = a\nontimer:\nid = 1"),
              (List{"2:10 ARRAY_SIZE_MISMATCH"}));
    EXPECT_EQ(errors_in("var a[2]\nontimer:\na = 1"), (List{"3:3 ARRAY_SIZE_MISMATCH"}));
}

TEST(Dialect, AliasesYieldToTheUsersOwnNames) {
    const Target target = paper_node();
    const auto load_address = [&](std::string_view source) {
        const Compilation done = compile(source, target, kSized, {});
        EXPECT_TRUE(done.ok());
        return done.ok() ? done.program.bytecode[3] & 0xfff : -1;
    };
    EXPECT_EQ(load_address("ontimer:\nid = args[1]"), 3);
    EXPECT_EQ(load_address("ontimer:\nid = source"), 1);
    EXPECT_EQ(load_address("var args[2]\nontimer:\nid = args[1]"), 36);
    EXPECT_EQ(errors_in("id = args[0]\n"), (List{"1:6 VARIABLE_NOT_DEFINED"}));
}

TEST(Dialect, AnEventWithoutSizeTakesWhatStandsOnItsLine) {
    const auto compiled = [](std::string_view source) {
        return compile(source, paper_node(), kUnsized, {});
    };
    const Compilation done =
        compiled("ontimer:\nemit SetLimit\nid = 3\nemit SetLimit [1, 2]\nemit SetLimit bumper");
    ASSERT_TRUE(done.ok()) << done.errors[0].message;
    const std::vector<uint16_t>& words = done.program.bytecode;
    EXPECT_EQ((std::vector<uint16_t>{words[3], words[4], words[5]}),
              (std::vector<uint16_t>{0xb001, 0, 0}));
    Target roomy = paper_node();
    roomy.variables_size = 1000;
    const auto sends = [&](int words_sent) {
        const std::string source =
            "var v[" + std::to_string(words_sent) + "]\nontimer:\nemit SetLimit v";
        return compile(source, roomy, kUnsized, {}).ok();
    };
    EXPECT_TRUE(sends(258));
    EXPECT_FALSE(sends(259));
    // In a modern program such an event carries nothing.
    EXPECT_EQ(compiled("emit SetLimit 3").errors.size(), 1u);
}

}  // namespace
}  // namespace vagus::aesl

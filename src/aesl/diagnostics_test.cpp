// Every entry of the registry can be provoked, and says its sentence with all places filled in.
#include "aesl/diagnostics.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "aesl/limits.hpp"
#include "aesl/test_node.hpp"
#include "base/file.hpp"
#include "base/test_places.hpp"

namespace vagus::aesl {
namespace {

struct Sample {
    std::string name;    // in the registry
    std::string source;  // a program whose first error, or one of whose warnings, this is
    Options options = {};
    Target target = test_target();
    CommonDefinitions common = test_common();
};

Target small(uint16_t bytecode, uint16_t variables, uint16_t stack) {
    Target target = test_target();
    target.bytecode_size = bytecode;
    target.variables_size = variables;
    target.stack_size = stack;
    return target;
}

Target without_timer() {
    Target target = test_target();
    target.local_events = {{"a", ""}, {"b", ""}};
    return target;
}

CommonDefinitions many_events() {
    CommonDefinitions common;
    for (int i = 0; i <= 4096; ++i) common.events.push_back({"e" + std::to_string(i), 0});
    return common;
}

std::vector<Sample> samples() {
    const std::string store = "motor.left = id\n";  // two words
    return {
        {"BrokenTarget", "", {}, small(600, 39, 32)},
        {"StackOverflow", "motor.left = id / (id / (id / id))\n", {}, small(600, 200, 3)},
        {"Recursion", "sub s\ncallsub s\n"},
        {"ScriptTooBig", "motor.left = id\n", {}, small(5, 200, 32)},
        {"UnrollsTooFar",
         "var v[1000]\nvar w[1000]\nif ZERO == 1 then\n" + repeated("v = w + w * w - w\n", 700) +
             "end\n",
         {},
         small(600, 4096, 32)},
        {"BlockTooLong",
         "if id == 1 then\n" + repeated(store, 16384) + "end\n",
         {},
         small(65535, 200, 32)},
        {"SubTooFar",
         "callsub s\n" + repeated(store, 2050) + "sub s\nmotor.left = 1\n",
         {},
         small(65535, 200, 32)},
        {"NumberTooHigh", "emit e4096\n", {}, test_target(), many_events()},
        {"SourceTooBig", std::string(kSourceBytesMax + 1, ' ')},
        {"TooManyLines", std::string(kSourceLinesMax, '\n')},
        {"NestedTooDeep", "motor.left = " + std::string(kNestingMax + 1, '(') + "1"},
        {"ExpressionTooLong", "motor.left = id" + repeated(" + id", kTreeDepthMax + 1)},
        {"OpenComment", "#* …"},
        {"StrangeSign", "motor.left = id – 1"},
        {"StrangeSpace", "motor.left =\u00a03"},
        {"QuotedText", "motor.left = \"fast\""},
        {"FractionWithoutZero", "motor.left = .5"},
        {"FractionBelowOne", "motor.left = 0.5"},
        {"DotsFromZero", "for id in 0..3 do end"},
        {"Fraction", "motor.left = 1.5"},
        {"Dots", "for id in 1..3 do end"},
        {"LoneBang", "motor.left = ! 3"},
        {"BadCharacter", "motor.left = 3;"},
        {"BadUtf8", "motor.left = \xff 3"},
        {"LeadingDot", "motor.left = .x"},
        {"BadHexadecimal", "motor.left = 0x"},
        {"BadBinary", "motor.left = 0b2"},
        {"BadBase", "motor.left = 0X5"},
        {"BadNumber", "motor.left = 12ms"},
        {"NumberTooLarge", "motor.left = 32768"},
        {"ConstantTooLarge", "motor.left = HUGE"},
        {"UnknownVariable", "motor.left = speed"},
        {"UnknownVariableGuess", "motor.left = motorleft"},
        {"UnknownLoopVariable", "for counter in 0:3 do end"},
        {"MisspeltKeyword", "If id == 1 then end"},
        {"UnknownWord", "int speed = 3"},
        {"TruthValue", "motor.left = true"},
        {"EndlessLoop", "while true do id++ end"},
        {"PartOfName", "id = motor"},
        {"PartOfNameGuess", "id = self.motor.left"},
        {"EventAsValue", "id = tick"},
        {"NativeAsValue", "motor.left = sys.nop()"},
        {"NativeResult", "motor.left = math.sqrt(id)"},
        {"NativeAsStatement", "math.fill(prox, 1)"},
        {"NativeAssigned", "math.fill = 1"},
        {"SubAsStatement", "stop\nsub stop\nmotor.left = 0"},
        {"SubAsValue", "id = stop()\nsub stop\nmotor.left = 0"},
        {"UnknownCall", "id = nothing(1)"},
        {"UnknownCallGuess", "fill(prox, 1)"},
        {"ForeignWord", "wait(1)"},
        {"UnknownNative", "call nothing(id)"},
        {"UnknownNativeGuess", "call math.fil(prox, 1)"},
        {"SubNotNative", "sub stop\nmotor.left = 0\nonevent tick\ncall stop()"},
        {"UnknownConstant", "var i\nfor i in 0:finish do end"},
        {"UnknownConstantGuess", "var i\nfor i in 0:LIMT do end"},
        {"VariableAsBound", "var i\nfor i in 0:id do end"},
        {"RangeAsBound", "for id in range(3) do end"},
        {"UnknownEvent", "onevent nothing"},
        {"VariableAsEvent", "onevent id"},
        {"UnknownEventGuess", "onevent tik"},
        {"NoPeriodicEvent", "ontimer:\n", {}, without_timer()},
        {"UnknownPeriodicEvent", "ontimer:\n", {.dialect = Dialect::Auto, .ontimer = "beat"}},
        {"EmitLocalEvent", "emit tick"},
        {"UnknownSub", "callsub nothing"},
        {"UnknownSubGuess", "callsub stp\nsub stop\n"},
        {"NativeNotSub", "callsub sys.nop"},
        {"ExpectedStatement", "then"},
        {"HeaderOpensBlock", "onevent tick do motor.left = 1 end"},
        {"SubWithParentheses", "sub stop()\nmotor.left = 0"},
        {"SlashComment", "// note"},
        {"BracketsWanted", "id = prox(1)"},
        {"CountInExpression", "motor.left = id++"},
        {"CountBefore", "++id"},
        {"SecondAssignment", "motor.left = id = 3"},
        {"ValueMissing", "motor.left =\nid = 3"},
        {"CommaInVar", "var a, b"},
        {"DashInName", "var left-speed = 3"},
        {"ReturnWithNumber", "return 3"},
        {"NeedlessColon", "if id == 1 then else: id = 3 end"},
        {"NeedlessThen", "if id == 1 then else then id = 3 end"},
        {"ComparedInAssignment", "motor.left = id == 3"},
        {"ListWithoutBrackets", "var v[2] = 1 + 1, 2"},
        {"EventTakesNoArgument", "emit ping 3"},
        {"IndexOfExpression", "motor.left = prox[1][0]"},
        {"LeftTuple", "[motor.left, motor.right] = [1, 2]"},
        {"StrayEnd", "motor.left = 1\nend"},
        {"StrayElse", "motor.left = 1\nelse"},
        {"ElseAfterElse", "if id == 1 then else elseif id == 2 then end"},
        {"ElseInLoop", "when id == 1 do else end"},
        {"MisplacedConst", "var a\nconst K = 1\na = K"},
        {"VarInBlock", "if id == 1 then var a end"},
        {"MissingEnd", "if id == 1 then"},
        {"ElseIfInTwoWords", "if id == 1 then\nelse if id == 2 then\nend\n"},
        {"ExpectedThen", "if id == 1 motor.left = 1 end"},
        {"ThenAfterAssign", "if id = 1 then end"},
        {"ThenAfterSlip", "if id => 1 then end"},
        {"ExpectedDo", "while id == 1 motor.left = 1 end"},
        {"ExpectedIn", "for id from 0:3 do end"},
        {"ExpectedLoopColon", "for id in 0 3 do end"},
        {"ExpectedBound", "for id in 0:(3) do end"},
        {"ExpectedDoOrStep", "for id in 0:LIMIT-1 do end"},
        {"ExpectedLoopVariable", "for 3 in 0:3 do end"},
        {"ExpectedEventName", "emit 3"},
        {"ExpectedSubName", "callsub 3"},
        {"ExpectedNativeName", "call 3"},
        {"ExpectedArguments", "call math.fill prox, 1"},
        {"ExpectedNextArgument", "call math.fill(prox 1)"},
        {"ExpectedCallEnd", "call math.fill(prox, 1"},
        {"ExpectedParenClose", "motor.left = (1"},
        {"ParenAssign", "if (id = 1) then end"},
        {"ExpectedBracketClose", "motor.left = prox[1"},
        {"SliceStartNotConstant", "motor.left = prox[id:3]"},
        {"ExpectedTupleEnd", "prox = [1, 2 3, 4]"},
        {"ExpectedOperand", "motor.left = *"},
        {"DoubledOperator", "if id == 1 && id == 2 then end"},
        {"OperatorSlip", "if id === 1 then end"},
        {"NoPower", "id = id ** 2"},
        {"CommentInExpression", "id = 3 // note"},
        {"EndOfKind", "if id == 1 then id = 2 end if"},
        {"UnaryPlus", "motor.left = +3"},
        {"NotInExpression", "if id == not 1 then end"},
        {"EmptyTuple", "prox = []"},
        {"MissingEventArgument", "emit report"},
        {"MisplacedVar", "motor.left = 1\nvar a"},
        {"ExpectedDeclaredName", "var 3"},
        {"KeywordAsName", "var if"},
        {"ExpectedAssignment", "motor.left + id then"},
        {"ReturnWithValue", "return id"},
        {"NameAlone", "motor.left\nid = 3"},
        {"SubNameAlone", "var stop\nstop\nsub stop\nid = 0"},
        {"SignMissing", "motor.left 3"},
        {"PairAssigned", "motor.left, id = 1"},
        {"ColonAssigned", "motor.left := 1"},
        {"ComparisonAsStatement", "motor.left == 3"},
        {"CallWithoutKeyword", "var sys.nop\nsys.nop()"},
        {"ExpectedConstAssign", "const K 3"},
        {"ConstantTwice", "const LIMIT = 1"},
        {"VariableTwice", "var id"},
        {"VariableIsConstant", "var LIMIT"},
        {"UndefinedSize", "var a[]"},
        {"NotEnoughSpace", "var a[161]"},
        {"SizeNegative", "var a[-1]"},
        {"SizeZero", "var a[0]"},
        {"SizeNotConstant", "var a[id]"},
        {"ConstantNotConstant", "const K = id"},
        {"HandlerTwice", "onevent tick\nonevent tick"},
        {"SubTwice", "sub s\nsub s"},
        {"LoopStepZero", "for id in 0:3 step 0 do end"},
        {"LoopStartTooHigh", "for id in 3:0 do end"},
        {"LoopStartTooLow", "for id in 0:3 step -1 do end"},
        {"LoopEndMax", "for id in 0:32767 do end"},
        {"LoopEndMin", "for id in 0:-32768 step -1 do end"},
        {"InfiniteLoop", "while 1 == 1 do id++ end"},
        {"EventArgumentTooBig", "_emit report prox"},
        {"EventArgumentSize", "emit report prox"},
        {"NativeTakesNothing", "call sys.nop(1)"},
        {"TooFewArguments", "call math.fill(prox)"},
        {"NativeArgumentSize", "call math.fill(prox, prox)"},
        {"NativeTemplateSize", "call math.copy(prox, id)"},
        {"TooManyArguments", "call math.fill(prox, 1, 2)"},
        {"NoTemporarySpace", "var a[159]\nemit triple [1, 2, 3]"},
        {"SliceEndNotConstant", "motor.left = prox[0:id]"},
        {"SliceReversed", "motor.left = prox[2:1]"},
        {"IndexOutOfBounds", "motor.left = prox[4]"},
        {"IndexNotSingle", "motor.left = prox[prox]"},
        {"SizeMismatch", "prox = 1"},
        {"LoopVariableIsArray", "for prox in 0:3 do end"},
        {"VectorCondition", "if prox == [1, 2, 3, 4] then end"},
        {"VectorWhile", "while prox == [1, 2, 3, 4] do end"},
        {"NotAssignable", "LIMIT = 3"},
        {"ConditionExpected", "if id then end"},
        {"NumberExpected", "motor.left = (id == 1)"},
        {"DivisionByZero", "motor.left = id / 0"},
        {"AbsOfMinimum", "motor.left = abs -32768"},
        {"UnusedVariable", "var a"},
        {"UnusedSub", "sub s\nmotor.left = 1"},
        {"Unreachable", "return\nmotor.left = 1"},
        {"AlwaysTrue", "if 1 == 1 then motor.left = 1 end"},
        {"AlwaysFalse", "when 1 == 2 do motor.left = 1 end"},
        {"WhenAlwaysTrue", "when 1 == 1 do motor.left = 1 end"},
        {"LoopNeverEnds", "for id in 0:32766 step 1000 do end"},
        {"DivisionRoundsDown", "motor.left = (id - 3) / 2"},
        {"EmptyHandler", "onevent tick"},
    };
}

// Whether a sentence is the wording with something put in its places.
bool fits(std::string_view sentence, std::string_view wording) {
    size_t at = 0;
    bool is_start = true;
    while (!wording.empty()) {
        const size_t place = std::min(wording.find('{'), wording.size());
        const size_t found = sentence.find(wording.substr(0, place), at);
        if (found == sentence.npos || (is_start && found != 0)) return false;
        is_start = false;
        at = found + place;
        wording.remove_prefix(std::min(place + 3, wording.size()));
    }
    return true;
}

TEST(Diagnostics, EveryEntryHasAProgramThatProvokesIt) {
    std::set<std::string> provoked;
    for (const Sample& sample : samples()) {
        const Compilation done =
            compile(sample.source, sample.target, sample.common, sample.options);
        const auto entry =
            std::find_if(catalogue().begin(), catalogue().end(),
                         [&](const CatalogueEntry& e) { return e.name == sample.name; });
        ASSERT_NE(entry, catalogue().end()) << sample.name;
        std::vector<Diagnostic> found = done.warnings;
        if (!entry->is_warning() && !done.ok()) found = {done.first_error()};
        const bool is_there = std::any_of(found.begin(), found.end(), [&](const Diagnostic& d) {
            return d.code == entry->code && d.number == entry->number &&
                   fits(d.message, entry->wording);
        });
        EXPECT_TRUE(is_there) << sample.name
                              << ", found: " << (found.empty() ? "nothing" : found[0].message);
        provoked.insert(sample.name);
    }
    for (const CatalogueEntry& entry : catalogue()) {
        EXPECT_TRUE(provoked.contains(std::string(entry.name))) << entry.name << " has no sample";
    }
}

// The numbers of the catalogue, section 3.9 of the specification.
TEST(Diagnostics, CodesAndNumbersAreThoseOfTheCatalogue) {
    const std::map<std::string_view, int> numbers = {
        {"BROKEN_TARGET", 0},
        {"STACK_OVERFLOW", 1},
        {"SCRIPT_TOO_BIG", 2},
        {"VARIABLE_NOT_DEFINED", 3},
        {"VARIABLE_NOT_DEFINED_GUESS", 4},
        {"FUNCTION_NOT_DEFINED", 5},
        {"FUNCTION_NOT_DEFINED_GUESS", 6},
        {"CONSTANT_NOT_DEFINED", 7},
        {"CONSTANT_NOT_DEFINED_GUESS", 8},
        {"EVENT_NOT_DEFINED", 9},
        {"EVENT_NOT_DEFINED_GUESS", 10},
        {"EMIT_LOCAL_EVENT", 11},
        {"SUBROUTINE_NOT_DEFINED", 12},
        {"SUBROUTINE_NOT_DEFINED_GUESS", 13},
        {"UNBALANCED_COMMENT_BLOCK", 16},
        {"SYNTAX", 17},
        {"INVALID_IDENTIFIER", 18},
        {"INVALID_HEXA_NUMBER", 19},
        {"INVALID_BINARY_NUMBER", 20},
        {"NUMBER_INVALID_BASE", 21},
        {"IN_NUMBER", 22},
        {"EXPECTING", 24},
        {"INT16_OUT_OF_RANGE", 28},
        {"CONSTANT_OUT_OF_RANGE", 30},
        {"EXPECTING_ONE_OF", 31},
        {"NOT_ENOUGH_TEMP_SPACE", 32},
        {"MISPLACED_VARDEF", 33},
        {"EXPECTING_IDENTIFIER", 34},
        {"CONST_ALREADY_DEFINED", 35},
        {"VAR_ALREADY_DEFINED", 36},
        {"VAR_CONST_COLLISION", 37},
        {"UNDEFINED_SIZE", 38},
        {"NOT_ENOUGH_SPACE", 39},
        {"EXPECTING_ASSIGNMENT", 40},
        {"FOR_NULL_STEPS", 41},
        {"FOR_START_HIGHER_THAN_END", 42},
        {"FOR_START_LOWER_THAN_END", 43},
        {"FOR_INVALID_INC_END_INDEX", 44},
        {"FOR_INVALID_DEC_END_INDEX", 45},
        {"EVENT_ALREADY_IMPL", 46},
        {"EVENT_ARG_TOO_BIG", 47},
        {"EVENT_WRONG_ARG_SIZE", 48},
        {"SUBROUTINE_ALREADY_DEF", 49},
        {"INDEX_EXPECTING_CONSTANT", 50},
        {"INDEX_WRONG_END", 51},
        {"SIZE_IS_NEGATIVE", 52},
        {"SIZE_IS_NULL", 53},
        {"NOT_CONST_EXPR", 54},
        {"FUNCTION_HAS_NO_ARG", 55},
        {"FUNCTION_NO_ENOUGH_ARG", 56},
        {"FUNCTION_WRONG_ARG_SIZE", 57},
        {"FUNCTION_WRONG_ARG_SIZE_TEMPLATE", 58},
        {"FUNCTION_TOO_MANY_ARG", 59},
        {"INCORRECT_LEFT_VALUE", 61},
        {"ARRAY_OUT_OF_BOUND", 62},
        {"ARRAY_SIZE_MISMATCH", 63},
        {"IF_VECTOR_CONDITION", 64},
        {"WHILE_VECTOR_CONDITION", 65},
        {"ARRAY_ILLEGAL_ACCESS", 66},
        {"INFINITE_LOOP", 67},
        {"DIVISION_BY_ZERO", 68},
        {"ABS_NOT_POSSIBLE", 69},
        {"EXPECTING_TYPE", 72},
    };
    std::set<std::string_view> seen;
    for (const CatalogueEntry& entry : catalogue()) {
        if (entry.is_warning()) continue;
        ASSERT_TRUE(numbers.contains(entry.code)) << entry.code;
        EXPECT_EQ(entry.number, numbers.at(entry.code)) << entry.name;
        seen.insert(entry.code);
    }
    EXPECT_EQ(seen.size(), numbers.size());
}

TEST(Diagnostics, ThePageInTheDocumentationIsCurrent) {
    const auto page = read_file(test::docs("diagnostics.md"));
    ASSERT_TRUE(page.ok());
    EXPECT_EQ(page.value(), catalogue_page())
        << "run: build/release/bin/aesl_catalogue > docs/diagnostics.md";
}

TEST(Diagnostics, ASentenceNamesTheThingAndHowToMendIt) {
    EXPECT_EQ(sentence_of("var speed\nspeed = sped + 1\n"),
              "there is no variable or constant \"sped\" at this point; did you mean \"speed\"?");
    EXPECT_EQ(
        sentence_of("var a[3]\na = 1\n"),
        "both sides of \"=\" must have the same size, but the left has 3 words and the right has 1 "
        "word; make the sizes equal (a single value is not spread over an array)");
    EXPECT_EQ(
        sentence_of("if id == 1 then\nid = 2\n"),
        "expected \"end\" for the \"if\" of line 1, found the end of the text; put \"end\" behind "
        "the last statement of the block");
    EXPECT_EQ(sentence_of("whlie id < 3 do end"),
              "\"whlie\" is no keyword and no variable; did you mean \"while\"?");
}

TEST(Diagnostics, TheRangeCoversWhatIsMeant) {
    const Compilation done = compile_here("var höhe = 1\nmotor.left = hoehe\n");
    ASSERT_EQ(done.errors.size(), 1u);
    EXPECT_EQ(done.errors[0].at, (Position{2, 14}));
    EXPECT_EQ(done.errors[0].end, (Position{2, 19}));
    EXPECT_EQ(compile_here("a").errors[0].end, (Position{1, 2}));
    EXPECT_EQ(compile_here("if id == 1 then").errors[0].at, (Position{1, 16}));
    EXPECT_EQ(compile_here("if id == 1 then").errors[0].end, (Position{1, 16}));
}

TEST(Diagnostics, ALongNameIsCutInTheSentence) {
    const Compilation done = compile_here("motor.left = " + std::string(10000, 'x'));
    ASSERT_EQ(done.errors.size(), 1u);
    EXPECT_LT(done.errors[0].message.size(), 300u);
}

TEST(Diagnostics, SuggestionsFollowTheEditDistance) {
    EXPECT_EQ(errors_of("var abcd\nvar abce\nmotor.left = abcf\nabcd=abce"),
              (List{"3:14 VARIABLE_NOT_DEFINED_GUESS"}));
    // Equal distance: the first in code-point order, whatever the order of the declarations.
    EXPECT_NE(sentence_of("var abce\nvar abcd\nmotor.left = abcf").find("\"abcd\""),
              std::string::npos);
    // Distance 2 is near enough, 3 is not; the smaller distance wins.
    EXPECT_NE(sentence_of("var abcdef\nmotor.left = abcd").find("\"abcdef\""), std::string::npos);
    EXPECT_EQ(errors_of("var abcdef\nmotor.left = abc"), (List{"2:14 VARIABLE_NOT_DEFINED"}));
    EXPECT_NE(sentence_of("var abcdx\nvar abcdyz\nmotor.left = abcdyy").find("\"abcdyz\""),
              std::string::npos);
}

}  // namespace
}  // namespace vagus::aesl

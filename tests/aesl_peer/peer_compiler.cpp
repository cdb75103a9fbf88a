// Debian's compiler behind peer.hpp. Only its public headers are known here.
#include <clocale>
#include <sstream>

#include "aesl/diagnostics.hpp"
#include "base/text.hpp"
#include "compiler/compiler.h"
#include "peer.hpp"

namespace vagus::aesl {

std::wstring widened(std::string_view text) {
    std::wstring characters;
    while (!text.empty()) {
        const CodePoint point = first_code_point(text);
        if (point.bytes == 0) break;  // the cases are well-formed
        characters.push_back(static_cast<wchar_t>(point.value));
        text.remove_prefix(point.bytes);
    }
    return characters;
}

namespace {

std::string narrow(const std::wstring& text) {
    std::string bytes;
    for (const wchar_t character : text) bytes += to_utf8(static_cast<char32_t>(character));
    return bytes;
}

// Instead of a translated sentence every message begins with the number of its error; the rest is
// where the compiler puts its words, which must be there.
const std::wstring number_of(Aseba::ErrorCode code) {
    return std::to_wstring(static_cast<int>(code)) + L" " +
           Aseba::ErrorMessages::defaultCallback(code);
}

std::string code_of(const Aseba::Error& error) {
    const int number = static_cast<int>(std::wcstol(error.message.c_str(), nullptr, 10));
    for (const CatalogueEntry& entry : catalogue())
        if (!entry.is_warning() && entry.number == number) return without_guess(entry.code);
    return narrow(error.message);
}

Aseba::TargetDescription described(const Target& target) {
    Aseba::TargetDescription peer;
    peer.name = widened(target.name);
    peer.protocolVersion = target.protocol_version;
    peer.bytecodeSize = target.bytecode_size;
    peer.variablesSize = target.variables_size;
    peer.stackSize = target.stack_size;
    for (const NamedVariable& variable : target.variables)
        peer.namedVariables.emplace_back(widened(variable.name), variable.size);
    for (const LocalEvent& event : target.local_events)
        peer.localEvents.push_back({widened(event.name), L""});
    for (const NativeFunction& native : target.natives) {
        Aseba::TargetDescription::NativeFunction function{widened(native.name), L"", {}};
        for (const NativeParameter& parameter : native.parameters)
            function.parameters.emplace_back(widened(parameter.name), parameter.size);
        peer.nativeFunctions.push_back(function);
    }
    return peer;
}

Aseba::CommonDefinitions described(const CommonDefinitions& common) {
    Aseba::CommonDefinitions peer;
    for (const GlobalEvent& event : common.events)
        peer.events.emplace_back(widened(event.name), event.size.value_or(0));
    for (const Constant& each : common.constants)
        peer.constants.emplace_back(widened(each.name), each.value);
    return peer;
}

}  // namespace

struct PeerCompiler::Insides {
    Aseba::TargetDescription target;
    Aseba::CommonDefinitions common;
    Aseba::Compiler compiler;
};

PeerCompiler::PeerCompiler(const NodeFile& node)
    : insides_(new Insides{described(node.target), described(node.common), {}}) {
    // Without a UTF-8 locale the compiler calls letters illegal characters.
    std::setlocale(LC_CTYPE, "C.UTF-8");
    insides_->compiler.setTranslateCallback(number_of);
    insides_->compiler.setTargetDescription(&insides_->target);
    insides_->compiler.setCommonDefinitions(&insides_->common);
}

PeerCompiler::~PeerCompiler() = default;

PeerProgram PeerCompiler::compile(const std::string& source) {
    std::wistringstream text(widened(source));
    Aseba::BytecodeVector bytecode;
    unsigned variables_in_use = 0;
    Aseba::Error error;
    PeerProgram program;
    if (!insides_->compiler.compile(text, bytecode, variables_in_use, error)) {
        const int line = error.pos.valid ? static_cast<int>(error.pos.row) + 1 : 0;
        program.error = CompileError{code_of(error), line};
        return program;
    }
    for (const Aseba::BytecodeElement& element : bytecode) {
        program.bytecode.push_back(element.bytecode);
        program.lines.push_back(element.line + 1);
    }
    for (const auto& [name, place] : *insides_->compiler.getVariablesMap())
        program.variables[narrow(name)] = {place.first, place.second};
    return program;
}

bool PeerCompiler::compiles(const std::wstring& source) {
    std::wistringstream text(source);
    Aseba::BytecodeVector bytecode;
    unsigned variables_in_use = 0;
    Aseba::Error error;
    return insides_->compiler.compile(text, bytecode, variables_in_use, error);
}

}  // namespace vagus::aesl

#include "plan/formula.hpp"

#include <algorithm>
#include <cassert>

#include "plan/operate.hpp"

namespace vagus::plan {

// Runs the steps on values.
class Formula::Evaluator {
public:
    Evaluator(const Formula& formula, std::span<const Value> values)
        : formula_(formula), values_(values) {}

    Result<Value> run() {
        if (formula_.ifs_ > 0) TRY(find_types_of_ifs());
        while (at_ < formula_.steps_.size()) {
            const Step& step = formula_.steps_[at_];
            ++at_;
            TRY(take(step));
        }
        return std::move(stack_.back());
    }

private:
    // The type of `if` does not depend on the side that is chosen (P9b).
    Status find_types_of_ifs() {
        std::vector<Type> types;
        for (const Value& value : values_) types.push_back(value.type());
        ifs_ = TRY(formula_.types_of(types)).of_ifs;
        return Status::done();
    }

    Status take(const Step& step) {
        switch (step.op) {
            case FormulaOp::Constant:
                stack_.push_back(formula_.constants_[step.index]);
                return Status::done();
            case FormulaOp::Variable:
                stack_.push_back(values_[step.index]);
                return Status::done();
            case FormulaOp::Negate:
            case FormulaOp::Not:
                stack_.back() = TRY(apply(step.op, stack_.back()));
                return Status::done();
            case FormulaOp::And:
            case FormulaOp::Or:
                return decide(step);
            case FormulaOp::Truth:
                stack_.back() = TRY(convert(stack_.back(), Type::Bool));
                return Status::done();
            case FormulaOp::Branch:
                return branch(step);
            case FormulaOp::Else:
                at_ = step.index;
                return Status::done();
            case FormulaOp::EndIf:
                stack_.back() = TRY(convert(stack_.back(), ifs_[step.index]));
                return Status::done();
            case FormulaOp::Call:
                return call(step);
            case FormulaOp::Add:
            case FormulaOp::Subtract:
            case FormulaOp::Join:
            case FormulaOp::Multiply:
            case FormulaOp::Divide:
            case FormulaOp::Modulo:
            case FormulaOp::Equal:
            case FormulaOp::NotEqual:
            case FormulaOp::Less:
            case FormulaOp::LessOrEqual:
            case FormulaOp::Greater:
            case FormulaOp::GreaterOrEqual:
                break;
        }
        return combine(step.op);
    }

    Status decide(const Step& step) {
        stack_.back() = TRY(convert(stack_.back(), Type::Bool));
        if (stack_.back().boolean() == (step.op == FormulaOp::Or)) {
            at_ = step.index;
        } else {
            stack_.pop_back();
        }
        return Status::done();
    }

    Status branch(const Step& step) {
        const Value condition = TRY(convert(stack_.back(), Type::Bool));
        stack_.pop_back();
        if (!condition.boolean()) at_ = step.index;
        return Status::done();
    }

    Status call(const Step& step) {
        const std::span<const Value> arguments = std::span(stack_).last(step.count);
        Value result = TRY(apply(static_cast<Function>(step.index), arguments));
        stack_.resize(stack_.size() - step.count);
        stack_.push_back(std::move(result));
        return Status::done();
    }

    Status combine(FormulaOp op) {
        const Value right = std::move(stack_.back());
        stack_.pop_back();
        stack_.back() = TRY(apply(op, stack_.back(), right));
        return Status::done();
    }

    const Formula& formula_;
    std::span<const Value> values_;
    std::vector<Type> ifs_;
    std::vector<Value> stack_;
    size_t at_ = 0;
};

// Goes through all steps, also those that evaluating would jump over, with types.
class Formula::Typist {
public:
    Typist(const Formula& formula, std::span<const Type> types) : formula_(formula), types_(types) {
        found_.of_ifs.resize(formula.ifs_);
    }

    Result<Types> run() {
        for (const Step& step : formula_.steps_) TRY(take(step));
        found_.result = stack_.back();
        return std::move(found_);
    }

private:
    Status take(const Step& step) {
        switch (step.op) {
            case FormulaOp::Constant:
                stack_.push_back(formula_.constants_[step.index].type());
                return Status::done();
            case FormulaOp::Variable:
                stack_.push_back(types_[step.index]);
                return Status::done();
            case FormulaOp::Negate:
            case FormulaOp::Not:
                stack_.back() = TRY(type_of(step.op, stack_.back()));
                return Status::done();
            case FormulaOp::Truth:
                stack_.back() = TRY(type_of(FormulaOp::Not, stack_.back()));
                return Status::done();
            case FormulaOp::And:
            case FormulaOp::Or:
            case FormulaOp::Branch:
                return check_condition(step.op);
            case FormulaOp::Else:
                return Status::done();
            case FormulaOp::EndIf:
                return join_sides(step);
            case FormulaOp::Call:
                return call(step);
            case FormulaOp::Add:
            case FormulaOp::Subtract:
            case FormulaOp::Join:
            case FormulaOp::Multiply:
            case FormulaOp::Divide:
            case FormulaOp::Modulo:
            case FormulaOp::Equal:
            case FormulaOp::NotEqual:
            case FormulaOp::Less:
            case FormulaOp::LessOrEqual:
            case FormulaOp::Greater:
            case FormulaOp::GreaterOrEqual:
                break;
        }
        return combine(step.op);
    }

    Status check_condition(FormulaOp op) {
        const Type type = stack_.back();
        stack_.pop_back();
        if (type != Type::Object) return Status::done();
        const std::string_view word = op == FormulaOp::Branch ? "if" : symbol_of(op);
        return Error{Code::BadInput, "an object cannot be a condition of " + std::string(word)};
    }

    Status join_sides(const Step& step) {
        const Type right = stack_.back();
        stack_.pop_back();
        stack_.back() = TRY(type_of_sides(stack_.back(), right));
        found_.of_ifs[step.index] = stack_.back();
        return Status::done();
    }

    Status call(const Step& step) {
        const std::span<const Type> arguments = std::span(stack_).last(step.count);
        const Type result = TRY(type_of(static_cast<Function>(step.index), arguments));
        stack_.resize(stack_.size() - step.count);
        stack_.push_back(result);
        return Status::done();
    }

    Status combine(FormulaOp op) {
        const Type right = stack_.back();
        stack_.pop_back();
        stack_.back() = TRY(type_of(op, stack_.back(), right));
        return Status::done();
    }

    const Formula& formula_;
    std::span<const Type> types_;
    std::vector<Type> stack_;
    Types found_{};
};

Formula::Formula(Value constant) : steps_{{FormulaOp::Constant, 0, 0}} {
    constants_.push_back(std::move(constant));
}

Result<Value> Formula::evaluate(std::span<const Value> values) const {
    assert(values.size() == names_.size());
    return Evaluator(*this, values).run();
}

Result<Formula::Types> Formula::types_of(std::span<const Type> types) const {
    assert(types.size() == names_.size());
    return Typist(*this, types).run();
}

Result<Type> Formula::type(std::span<const Type> types) const {
    return TRY(types_of(types)).result;
}

const std::string* Formula::single_name() const {
    return steps_.size() == 1 && steps_[0].op == FormulaOp::Variable ? &names_[0] : nullptr;
}

std::vector<Formula::ComparedText> Formula::compared_texts() const {
    std::vector<ComparedText> compared;
    for (size_t i = 2; i < steps_.size(); ++i) {
        if (steps_[i].op != FormulaOp::Equal && steps_[i].op != FormulaOp::NotEqual) continue;
        const Step* name = &steps_[i - 2];
        const Step* text = &steps_[i - 1];
        if (name->op == FormulaOp::Constant) std::swap(name, text);
        if (name->op != FormulaOp::Variable || text->op != FormulaOp::Constant) continue;
        const Value& constant = constants_[text->index];
        if (constant.type() == Type::String) compared.push_back({name->index, constant.string()});
    }
    return compared;
}

}  // namespace vagus::plan

// A value that many hold and nobody changes: copies share it. What is equal in thousands of places
// is there once. Without a value it reads as an empty one.
//
//     const SharedValue<std::string> one = std::string("a long text");
//     const SharedValue<std::string> other = one;   // no second text
//     show(other->size());
#pragma once

#include <memory>
#include <utility>

namespace vagus {

template <typename T>
class SharedValue {
public:
    SharedValue() = default;
    SharedValue(T value) : value_(std::make_shared<const T>(std::move(value))) {}

    bool has_value() const { return value_ != nullptr; }
    explicit operator bool() const { return has_value(); }
    void reset() { value_.reset(); }
    const T& operator*() const { return value_ ? *value_ : none(); }
    const T* operator->() const { return &**this; }
    operator const T&() const { return **this; }
    // The very same, not only equal.
    bool shares(const SharedValue& other) const { return value_ == other.value_; }

private:
    static const T& none() {
        static const T kNone{};
        return kNone;
    }

    // Owners: all copies of this one.
    std::shared_ptr<const T> value_;
};

}  // namespace vagus

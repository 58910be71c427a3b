#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "volmesh/handles.hh"
#include "volmesh/property_text.hh"

namespace maille::volmesh {

/// How the value of a property passes to what an edge split a-b -> a-m-b creates.
enum class PropertyRule : std::uint8_t {
    none,         ///< what is new gets the default value
    copy,         ///< children get the parent's value; a new vertex gets that of its end with the lower index
    interpolate,  ///< vertices: linear between a and b
    share  ///< cells, faces, edges: an extensive quantity, split by volume, area or length, its sum conserved
};

/// The rule of a property: one of the above or functions of the user's.
template <class T>
struct PropertyHeritage {
    PropertyRule rule = PropertyRule::copy;  ///< where there is no function
    /// Vertices: value at m = (1 - ratio) a + ratio b.
    std::function<T(const T& at_a, const T& at_b, double ratio)> at_vertex{};
    /// Cells, faces, edges: values of the children that keep a and b; `ratio` is the part that the first one
    /// takes.
    std::function<std::pair<T, T>(const T& parent, double ratio)> at_children{};

    PropertyHeritage() = default;
    /// A rule alone.
    PropertyHeritage(PropertyRule r) : rule(r) {}  // NOLINT: a rule is a heritage
};

/// What a property's entities have before they are told otherwise: zeros for Eigen's types, which would have
/// no value at all.
template <class T>
T initial_value() {
    if constexpr (requires {
                      requires T::SizeAtCompileTime >
                      0;
                  }) {
        return T::Zero();
    } else {
        return T{};
    }
}

/// Who gets the values of entities that a local edit takes out.
struct Inheritance {
    /// An entity that is born.
    struct Heir {
        std::uint32_t index;   ///< its own
        std::uint32_t parent;  ///< one of the old ones; the invalid index for what has no parent
        double measure;        ///< volume, area or length
    };
    std::vector<std::uint32_t> olds;  ///< what goes
    std::vector<Heir> heirs;          ///< what comes
};

/// Values of one property, by entity index: the part that the mesh works with whatever the type.
class BaseProperty {
  public:
    /// Without values yet.
    explicit BaseProperty(std::string name) : name_(std::move(name)) {}
    virtual ~BaseProperty() = default;
    BaseProperty& operator=(const BaseProperty&) = delete;

    const std::string& name() const { return name_; }  ///< unique among those of its kind
    virtual const std::type_info& type() const = 0;    ///< of a value
    virtual PropertyRule rule() const = 0;             ///< what stands where there is no function
    /// Whether functions of the user's stand in for the rule.
    virtual bool has_own_rule() const = 0;
    ///@{
    /// A value, or that of entities that nothing is known of, in words, as text_of gives it.
    virtual std::string text(std::size_t i) const = 0;
    virtual std::string default_text() const = 0;
    ///@}
    virtual std::unique_ptr<BaseProperty> clone() const = 0;  ///< a copy, values and all
    virtual std::size_t size() const = 0;                     ///< number of values: indices in use
    virtual void resize(std::size_t n) = 0;                   ///< new ones get the default
    /// The vertex m is born between a and b.
    virtual void set_between(std::uint32_t m, std::uint32_t a, std::uint32_t b, double ratio) = 0;
    /// `child` is the second child of `parent`, which becomes the first child.
    virtual void set_child(std::uint32_t parent, std::uint32_t child, double ratio) = 0;
    /// A vertex at the end, born among others; the weights sum to 1.
    virtual void push_among(std::span<const std::uint32_t> parents, std::span<const double> weights) = 0;
    /// Cells, faces or edges replace others: `copy` takes the parent's value, `share` divides the sum of the
    /// old ones by measure, a function of the user's is asked where there is one old entity, again and again
    /// (otherwise its values are copied).
    virtual void pass_on(std::span<const Inheritance> inheritances) = 0;
    /// Keeps the values at these old indices, in this order.
    virtual void gather(const std::vector<std::uint32_t>& old_indices) = 0;
    /// Puts the values of another, of the same type, behind its own.
    virtual void append(const BaseProperty& more) = 0;

    /// @cond
  protected:
    BaseProperty(const BaseProperty&) = default;
    /// @endcond

  private:
    std::string name_;
};

/// The values of one property, with their type.
template <class T>
class Property final : public BaseProperty {
  public:
    /// As what a value is stored: as itself, but for bool, as std::vector<bool> has no references.
    using Stored = std::conditional_t<std::same_as<T, bool>, std::uint8_t, T>;

    /// Whether values can be added and scaled by a real number: floating point and Eigen's types, not
    /// integers.
    static constexpr bool is_linear = !std::is_integral_v<T> && requires(const T& t) {
        {t * 0.5};
        {T(t * 0.5 + t * 0.5)};
    };

    /// Without values yet.
    Property(std::string name, PropertyHeritage<T> heritage, T default_value)
        : BaseProperty(std::move(name)), heritage_(std::move(heritage)), default_(std::move(default_value)) {}

    ///@{
    /// By index of the entity.
    Stored& operator[](std::uint32_t i) { return values_[i]; }
    const Stored& operator[](std::uint32_t i) const { return values_[i]; }
    std::vector<Stored>& values() { return values_; }
    const std::vector<Stored>& values() const { return values_; }
    ///@}
    const PropertyHeritage<T>& heritage() const { return heritage_; }  ///< as given at the beginning
    const Stored& default_value() const { return default_; }           ///< of what nothing is known of

    const std::type_info& type() const override { return typeid(T); }
    PropertyRule rule() const override { return heritage_.rule; }
    bool has_own_rule() const override { return heritage_.at_vertex || heritage_.at_children; }
    std::string text(std::size_t i) const override { return text_of(static_cast<const T&>(values_[i])); }
    std::string default_text() const override { return text_of(static_cast<const T&>(default_)); }
    std::unique_ptr<BaseProperty> clone() const override {
        return std::unique_ptr<BaseProperty>(new Property(*this));
    }
    std::size_t size() const override { return values_.size(); }
    void resize(std::size_t n) override { values_.resize(n, default_); }
    void set_between(std::uint32_t m, std::uint32_t a, std::uint32_t b, double ratio) override;
    void set_child(std::uint32_t parent, std::uint32_t child, double ratio) override;
    void push_among(std::span<const std::uint32_t> parents, std::span<const double> weights) override;
    void pass_on(std::span<const Inheritance> inheritances) override;
    void gather(const std::vector<std::uint32_t>& old_indices) override;
    void append(const BaseProperty& more) override {
        const auto& values = static_cast<const Property&>(more).values_;
        values_.insert(values_.end(), values.begin(), values.end());
    }

  private:
    Property(const Property&) = default;
    std::vector<Stored> inherited(const Inheritance& inheritance) const;

    PropertyHeritage<T> heritage_;
    Stored default_;
    std::vector<Stored> values_;
};

template <class T>
void Property<T>::set_between(std::uint32_t m, std::uint32_t a, std::uint32_t b, double ratio) {
    Stored value = default_;
    if (heritage_.at_vertex) {
        value = heritage_.at_vertex(values_[a], values_[b], ratio);
    } else if (heritage_.rule == PropertyRule::copy) {
        value = values_[std::min(a, b)];
    } else if (heritage_.rule == PropertyRule::interpolate) {
        if constexpr (is_linear) value = static_cast<T>(values_[a] * (1 - ratio) + values_[b] * ratio);
    }
    values_[m] = std::move(value);
}

template <class T>
void Property<T>::set_child(std::uint32_t parent, std::uint32_t child, double ratio) {
    Stored first = default_;
    Stored second = default_;
    if (heritage_.at_children) {
        std::tie(first, second) = heritage_.at_children(values_[parent], ratio);
    } else if (heritage_.rule == PropertyRule::copy) {
        first = second = values_[parent];
    } else if (heritage_.rule == PropertyRule::share) {
        if constexpr (is_linear) {
            first = static_cast<T>(values_[parent] * ratio);
            second = static_cast<T>(values_[parent] - first);
        }
    }
    values_[parent] = std::move(first);
    values_[child] = std::move(second);
}

template <class T>
void Property<T>::push_among(std::span<const std::uint32_t> parents, std::span<const double> weights) {
    Stored value = default_;
    if (heritage_.at_vertex) {
        value = values_[parents[0]];
        double weight = weights[0];
        for (std::size_t i = 1; i < parents.size(); ++i) {
            weight += weights[i];
            value = heritage_.at_vertex(value, values_[parents[i]], weights[i] / weight);
        }
    } else if (heritage_.rule == PropertyRule::copy) {
        value = values_[std::ranges::min(parents)];
    } else if (heritage_.rule == PropertyRule::interpolate) {
        if constexpr (is_linear) {
            T sum = static_cast<T>(values_[parents[0]] * weights[0]);
            for (std::size_t i = 1; i < parents.size(); ++i)
                sum = static_cast<T>(sum + values_[parents[i]] * weights[i]);
            value = sum;
        }
    }
    values_.push_back(std::move(value));
}

template <class T>
auto Property<T>::inherited(const Inheritance& inheritance) const -> std::vector<Stored> {
    const auto& [olds, heirs] = inheritance;
    double measure = 0;
    for (const auto& heir : heirs) measure += heir.measure;
    std::vector<Stored> values;
    if (heritage_.at_children && olds.size() == 1) {
        Stored rest = values_[olds[0]];
        for (const auto& heir : heirs) {
            if (values.size() + 1 == heirs.size()) break;
            auto [first, second] = heritage_.at_children(rest, heir.measure / measure);
            values.push_back(std::move(first));
            rest = std::move(second);
            measure -= heir.measure;
        }
        values.push_back(std::move(rest));
        return values;
    }
    values.resize(heirs.size(), default_);
    if (heritage_.at_children || heritage_.rule == PropertyRule::copy) {
        for (std::size_t i = 0; i < heirs.size(); ++i)
            if (heirs[i].parent != VertexHandle::invalid_index) values[i] = values_[heirs[i].parent];
    } else if (heritage_.rule == PropertyRule::share && !olds.empty()) {
        if constexpr (is_linear) {
            T rest = values_[olds[0]];
            for (std::size_t i = 1; i < olds.size(); ++i) rest = static_cast<T>(rest + values_[olds[i]]);
            for (std::size_t i = 0; i + 1 < heirs.size(); ++i) {
                values[i] = static_cast<T>(rest * (heirs[i].measure / measure));
                rest = static_cast<T>(rest - values[i]);
                measure -= heirs[i].measure;
            }
            values.back() = rest;
        }
    }
    return values;
}

template <class T>
void Property<T>::pass_on(std::span<const Inheritance> inheritances) {
    std::vector<std::vector<Stored>> all;
    for (const Inheritance& inheritance : inheritances) all.push_back(inherited(inheritance));
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = 0; k < all[i].size(); ++k)
            values_[inheritances[i].heirs[k].index] = std::move(all[i][k]);
}

template <class T>
void Property<T>::gather(const std::vector<std::uint32_t>& old_indices) {
    std::vector<Stored> kept;
    kept.reserve(old_indices.size());
    for (std::uint32_t old : old_indices) kept.push_back(values_[old]);
    values_ = std::move(kept);
}

/// Place of a property in its mesh, with the kind of entity and the type of value.
template <class Entity, class T>
class PropertyHandle : public Handle<PropertyHandle<Entity, T>> {
  public:
    using Handle<PropertyHandle<Entity, T>>::Handle;
    using Value = T;  ///< of one entity
};
///@{
/// For TetMesh::add_property and what follows: a property of vertices, edges, faces or cells.
template <class T>
using VPropHandleT = PropertyHandle<VertexHandle, T>;
template <class T>
using EPropHandleT = PropertyHandle<EdgeHandle, T>;
template <class T>
using FPropHandleT = PropertyHandle<FaceHandle, T>;
template <class T>
using CPropHandleT = PropertyHandle<CellHandle, T>;
///@}
/// Stands for the mesh as a whole, which has properties too.
using MeshHandle = Handle<struct MeshKind>;
/// A property of the mesh as a whole: one value.
template <class T>
using MPropHandleT = PropertyHandle<MeshHandle, T>;

/// A property that can be indexed by handles of its own kind only. Valid until the property is removed.
template <class Entity, class T>
class PropertyView {
  public:
    /// TetMesh::property makes these.
    explicit PropertyView(Property<T>& values) : values_(&values) {}
    /// The entity's value, to be read or changed.
    typename Property<T>::Stored& operator[](Entity h) const { return (*values_)[h.idx()]; }

  private:
    Property<T>* values_;
};
///@{
/// The values of a property of vertices, edges, faces or cells.
template <class T>
using VProp = PropertyView<VertexHandle, T>;
template <class T>
using EProp = PropertyView<EdgeHandle, T>;
template <class T>
using FProp = PropertyView<FaceHandle, T>;
template <class T>
using CProp = PropertyView<CellHandle, T>;
///@}

/// All properties of one kind of entity. Copies deeply.
class PropertyList {
  public:
    PropertyList() = default;
    /// @cond
    PropertyList(const PropertyList& other);
    PropertyList& operator=(const PropertyList& other);
    PropertyList(PropertyList&&) noexcept = default;
    PropertyList& operator=(PropertyList&&) noexcept = default;
    ~PropertyList() = default;
    /// @endcond

    /// Index of the property; throws std::invalid_argument where the name is taken.
    std::uint32_t add(std::unique_ptr<BaseProperty> property);
    /// Its index is not used again.
    void remove(std::uint32_t i);
    /// Index of the property with this name and type; nothing found: the invalid index.
    std::uint32_t find(const std::string& name, const std::type_info& type) const;
    /// By an index that add or find gave, and that was not removed.
    BaseProperty& at(std::uint32_t i) const { return *properties_[i]; }
    /// Every property, in the order of their making; removed ones are null.
    const std::vector<std::unique_ptr<BaseProperty>>& all() const { return properties_; }
    bool empty() const;  ///< whether there are none, or all are removed

    /// Calls the action with each property that is not removed.
    template <class Action>
    void for_each(const Action& action) {
        for (auto& property : properties_)
            if (property) action(*property);
    }

  private:
    std::vector<std::unique_ptr<BaseProperty>> properties_;
};

}  // namespace maille::volmesh

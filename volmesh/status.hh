#pragma once

#include <cstdint>
#include <stdexcept>

namespace maille::volmesh {

/// Marks of an entity, as OpenMesh has them. They mean nothing to the mesh.
struct StatusBits {
    /// A bit each.
    enum Flag : std::uint8_t { selected = 1, tagged = 2, feature = 4, locked = 8, hidden = 16 };
    std::uint8_t bits = 0;  ///< those that are set
};

/// What an entity's marks are; all false where they have not been requested. Whether it is deleted is always
/// known.
class ConstStatus {
  public:
    /// `bits` is null where there are no marks. TetMesh::status makes these.
    ConstStatus(bool is_deleted, const StatusBits* bits) : is_deleted_(is_deleted), bits_(bits) {}

    /// Whether the entity is gone and waits for garbage_collection().
    bool deleted() const { return is_deleted_; }
    ///@{
    /// A mark of the user's.
    bool selected() const { return has(StatusBits::selected); }
    bool tagged() const { return has(StatusBits::tagged); }
    bool feature() const { return has(StatusBits::feature); }
    bool locked() const { return has(StatusBits::locked); }
    bool hidden() const { return has(StatusBits::hidden); }
    ///@}

  private:
    bool has(StatusBits::Flag flag) const { return bits_ != nullptr && (bits_->bits & flag) != 0; }

    bool is_deleted_;
    const StatusBits* bits_;
};

/// The same, to be changed. Throws std::logic_error where the marks have not been requested.
class Status : public ConstStatus {
  public:
    /// As ConstStatus.
    Status(bool is_deleted, StatusBits* bits) : ConstStatus(is_deleted, bits), bits_(bits) {}

    ///@{
    /// Sets a mark or takes it away.
    void set_selected(bool on) { set(StatusBits::selected, on); }
    void set_tagged(bool on) { set(StatusBits::tagged, on); }
    void set_feature(bool on) { set(StatusBits::feature, on); }
    void set_locked(bool on) { set(StatusBits::locked, on); }
    void set_hidden(bool on) { set(StatusBits::hidden, on); }
    ///@}

  private:
    void set(StatusBits::Flag flag, bool on) {
        if (bits_ == nullptr)
            throw std::logic_error("marks need their place first: call request_..._status() of the kind");
        bits_->bits = static_cast<std::uint8_t>(on ? bits_->bits | flag : bits_->bits & ~flag);
    }

    StatusBits* bits_;
};

}  // namespace maille::volmesh

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace vdbounce {

/// A ball in index space: centre and radius in voxels.
struct Ball {
    double x;
    double y;
    double z;
    double radius;
};

/// An array of balls that is not filled before it is written.
class BallList {
public:
    BallList() = default;
    explicit BallList(std::size_t size) : balls_(new Ball[size]), size_(size) {}

    const Ball* begin() const { return balls_.get(); }
    const Ball* end() const { return balls_.get() + size_; }
    Ball* data() { return balls_.get(); }
    const Ball& operator[](std::size_t i) const { return balls_[i]; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }

    /// Keeps the first `size`.
    void shrink(std::size_t size) { size_ = size; }

    /// Gives the memory back.
    void clear()
    {
        balls_.reset();
        size_ = 0;
    }

private:
    std::unique_ptr<Ball[]> balls_;
    std::size_t size_ = 0;
};

} // namespace vdbounce

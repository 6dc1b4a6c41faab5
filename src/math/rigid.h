// Motion of rigid bodies: a rotation and a translation.
#pragma once

#include "math/transform.h"

#include <Imath/ImathMatrix.h>
#include <Imath/ImathMatrixAlgo.h>
#include <Imath/ImathQuat.h>

namespace bdpt {

struct Rigid {
  Imath::Quatf rotation;  // identity by itself
  Vec3 translation{0, 0, 0};

  Vec3 vector(const Vec3& v) const { return rotation.rotateVector(v); }
  Vec3 point(const Vec3& p) const { return vector(p) + translation; }
  Vec3 back_vector(const Vec3& v) const { return rotation.inverse().rotateVector(v); }
  Vec3 back_point(const Vec3& p) const { return back_vector(p - translation); }
};

// From where an orthonormal frame is at time 0 to where it is later, turning and moving evenly to its place at time 1;
// both frames are right-handed, or both left-handed.
class RigidMotion {
 public:
  RigidMotion(const Transform& begin, const Transform& end) : begin_(begin.column(3)), end_(end.column(3)) {
    Imath::M33f turn;  // rows: end * transposed(begin), as Imath has vectors on the left
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) sum += double(end.m[4 * j + k]) * double(begin.m[4 * i + k]);
        turn[i][j] = float(sum);
      }
    turn_ = Imath::extractQuat(Imath::M44f(turn, Vec3(0)));
  }
  Rigid at(float time) const {
    Rigid r;
    r.rotation = Imath::slerpShortestArc(Imath::Quatf(), turn_, time);
    r.translation = begin_ * (1 - time) + end_ * time - r.vector(begin_);
    return r;
  }

 private:
  Vec3 begin_, end_;
  Imath::Quatf turn_;
};

}  // namespace bdpt

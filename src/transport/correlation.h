// Weights that know which samples share an eye subpath (Grittmann, Georgiev and Slusallek 2021).
//
// The n samples that a technique (s,t), s and t >= 2, takes of an eye vertex have z_0 ... z_{t-1} in common: their
// number lowers the variance of the light subpath and of the joining, not that of the eye subpath. Counting n in the
// weights trusts such a technique too much where it is the eye subpath that is hard to find. They count rho n instead,
//   1 / n <= rho = E / (E + L - E L) <= 1
// with E and L the chance that another subpath of that side comes near this one: products over its vertices of
// min(1, A p), A an area about each vertex, p its density. E much smaller than L: the eye subpath is what is rare.
//
// rho is a function of the path and of s, whichever technique made the path: the weights sum to one.
#pragma once

#include "transport/mis.h"

namespace bdpt {

// How many samples that have nothing in common count for the n of each technique: n_i for i = 0 ... k + 1 light
// vertices. Others than s, t >= 2 are left as they are, and so is an n of at most one.
void count_correlated(const PathTechniques& path, double* n);

}  // namespace bdpt

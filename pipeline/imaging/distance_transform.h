#pragma once

namespace dressform {

// cost[h] = min over g of cost[g] + price |h - g|, in place, and from[h] = that g (Felzenszwalb and Huttenlocher,
// "Distance transforms of sampled functions", Theory of Computing 2012). `count` entries each.
template <class Index>
void spread_costs(double* cost, Index* from, int count, double price) {
  for (int h = 0; h < count; ++h) from[h] = static_cast<Index>(h);
  const auto relax = [&](int h, int neighbour) {
    if (cost[neighbour] + price >= cost[h]) return;
    cost[h] = cost[neighbour] + price;
    from[h] = from[neighbour];
  };
  for (int h = 1; h < count; ++h) relax(h, h - 1);
  for (int h = count - 2; h >= 0; --h) relax(h, h + 1);
}

}  // namespace dressform

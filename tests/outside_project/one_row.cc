// Predictions in a loop, row by row: no memory is asked for.
#include <cstdlib>
#include <iostream>

#include <errmap/errmap.h>

static long allocations = 0;
void* operator new(std::size_t n) {
  ++allocations;
  return std::malloc(n);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto map = errmap::models::LoadModel(argv[1]);
  const std::vector<double> row(map.model->num_inputs(), 1.0);
  const long before = allocations;
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) sum += map.PredictFormRow(row, nullptr);
  std::cout << allocations - before << " allocations, sum " << sum << "\n";
}

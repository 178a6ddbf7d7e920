// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cuda_runtime.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <string>
#include <utility>

#include "src/core/base/error.hpp"

namespace whipple::device {

/// Throws if a call of the graphics processor failed.
inline void check(cudaError_t error) {
  if (error == cudaSuccess) return;
  throw StateError(std::string("the graphics processor: ") + cudaGetErrorString(error));
}

namespace gpu {

constexpr unsigned threads = 128;      ///< of a block
constexpr unsigned most_parts = 1024;  ///< of a reduction

template <class Kernel>
__global__ void __launch_bounds__(threads) for_each(std::size_t n, const Kernel kernel) {
  const std::size_t i = std::size_t{blockIdx.x} * threads + threadIdx.x;
  if (i < n) kernel(i);
}

/// Merges the results of the threads of a block in a fixed tree; thread 0 receives that of all.
template <class Result>
__device__ void merge_block(Result& own) {
  __shared__ double room[threads];
  const auto merge = [&](double& value, auto&& join) {
    room[threadIdx.x] = value;
    __syncthreads();
    for (unsigned half = threads / 2; half > 0; half /= 2) {
      if (threadIdx.x < half) room[threadIdx.x] = join(room[threadIdx.x], room[threadIdx.x + half]);
      __syncthreads();
    }
    value = room[0];
    __syncthreads();
  };
#pragma unroll
  for (std::size_t k = 0; k < Result::sums; ++k) {
    merge(own.sum[k], [](double a, double b) { return a + b; });
  }
#pragma unroll
  for (std::size_t k = 0; k < Result::maxima; ++k) {
    merge(own.largest[k], [](double a, double b) { return b > a ? b : a; });
  }
}

template <class Kernel>
__global__ void __launch_bounds__(threads)
    reduce(std::size_t n, const Kernel kernel, typename Kernel::Result* parts) {
  typename Kernel::Result own;
  for (std::size_t i = std::size_t{blockIdx.x} * threads + threadIdx.x; i < n;
       i += std::size_t{gridDim.x} * threads) {
    kernel(i, own);
  }
  merge_block(own);
  if (threadIdx.x == 0) parts[blockIdx.x] = own;
}

/// Merges the parts of a reduction in a further one.
template <class Part>
struct MergeParts {
  using Result = Part;
  const Part* parts;
  __device__ void operator()(std::size_t i, Result& result) const { result.merge(parts[i]); }
};

}  // namespace gpu

/// Runs the kernels of a device on a graphics processor.
class GpuSpace {
 public:
  template <class T>
  class Array {
   public:
    Array() = default;
    Array(const Array&) = delete;
    Array& operator=(const Array&) = delete;
    ~Array() { cudaFree(values_); }
    /// Makes room; what the array held is lost if it grows.
    void reserve(std::size_t n) {
      if (n <= size_) return;
      check(cudaFree(values_));
      values_ = nullptr;
      size_ = n + n / 8;
      check(cudaMalloc(&values_, size_ * sizeof(T)));
    }
    /// Makes exactly as much room as another array has: the two may then change places any number of times.
    void match(const Array& other) {
      if (size_ == other.size_) return;
      check(cudaFree(values_));
      values_ = nullptr;
      size_ = other.size_;
      check(cudaMalloc(&values_, size_ * sizeof(T)));
    }
    [[nodiscard]] T* data() { return values_; }
    [[nodiscard]] std::size_t bytes() const { return size_ * sizeof(T); }
    void upload(const T* from, std::size_t n, std::size_t at = 0) {
      check(cudaMemcpy(values_ + at, from, n * sizeof(T), cudaMemcpyHostToDevice));
    }
    void download(T* to, std::size_t n, std::size_t at = 0) const {
      check(cudaMemcpy(to, values_ + at, n * sizeof(T), cudaMemcpyDeviceToHost));
    }
    void swap(Array& other) {
      std::swap(values_, other.values_);
      std::swap(size_, other.size_);
    }

   private:
    T* values_ = nullptr;
    std::size_t size_ = 0;
  };

  static std::string name() {
    int device = 0;
    cudaDeviceProp properties{};
    check(cudaGetDevice(&device));
    check(cudaGetDeviceProperties(&properties, device));
    return properties.name;
  }
  static void synchronize() { check(cudaDeviceSynchronize()); }

  template <class Kernel>
  static void for_each(std::size_t n, const Kernel& kernel) {
    if (n == 0) return;
    gpu::for_each<<<static_cast<unsigned>((n + gpu::threads - 1) / gpu::threads), gpu::threads>>>(n, kernel);
    check(cudaGetLastError());
  }
  template <class Kernel>
  typename Kernel::Result reduce(std::size_t n, const Kernel& kernel) {
    using Result = typename Kernel::Result;
    if (n == 0) return {};
    const auto parts =
        static_cast<unsigned>(std::min<std::size_t>(gpu::most_parts, (n + gpu::threads - 1) / gpu::threads));
    parts_.reserve((parts + 1) * sizeof(Result));
    auto* const results = reinterpret_cast<Result*>(parts_.data());
    gpu::reduce<<<parts, gpu::threads>>>(n, kernel, results + 1);
    check(cudaGetLastError());
    gpu::reduce<<<1, gpu::threads>>>(parts, gpu::MergeParts<Result>{results + 1}, results);
    check(cudaGetLastError());
    Result result;
    check(cudaMemcpy(&result, results, sizeof(Result), cudaMemcpyDeviceToHost));
    return result;
  }
  /// Sets before[i] to the sum of the flags before i.
  /// @returns the sum of all
  std::uint32_t scan(const std::uint32_t* flags, std::uint32_t* before, std::size_t n) {
    if (n == 0) return 0;
    std::size_t bytes = 0;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, flags, before, n));
    scratch_.reserve(bytes);
    check(cub::DeviceScan::ExclusiveSum(scratch_.data(), bytes, flags, before, n));
    std::uint32_t last[2];
    check(cudaMemcpy(last, before + n - 1, sizeof(last[0]), cudaMemcpyDeviceToHost));
    check(cudaMemcpy(last + 1, flags + n - 1, sizeof(last[0]), cudaMemcpyDeviceToHost));
    return last[0] + last[1];
  }
  /// Sorts pairs by key; equal keys stay in order.
  void sort(Array<std::uint32_t>& keys, Array<std::uint32_t>& values, std::size_t n, unsigned bits) {
    other_keys_.match(keys);
    other_values_.match(values);
    cub::DoubleBuffer<std::uint32_t> key(keys.data(), other_keys_.data()),
        value(values.data(), other_values_.data());
    std::size_t bytes = 0;
    const auto end = static_cast<int>(bits);
    check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, key, value, n, 0, end));
    scratch_.reserve(bytes);
    check(cub::DeviceRadixSort::SortPairs(scratch_.data(), bytes, key, value, n, 0, end));
    if (key.Current() != keys.data()) keys.swap(other_keys_);
    if (value.Current() != values.data()) values.swap(other_values_);
  }

  /// Returns the memory of what reductions, scans and sorts need, bytes.
  [[nodiscard]] std::size_t bytes() const {
    return parts_.bytes() + scratch_.bytes() + other_keys_.bytes() + other_values_.bytes();
  }

 private:
  Array<std::uint8_t> parts_, scratch_;
  Array<std::uint32_t> other_keys_, other_values_;
};

}  // namespace whipple::device

// What naga's Metal text uses, as CUDA: enough to compile the shader, not to run it.
#pragma once

#define DEVICE __device__ __forceinline__

typedef unsigned int uint;

// The counter that naga puts into every loop, so that none is endless.
struct Bound {
    uint x, y;
    DEVICE Bound(uint both) : x(both), y(both) {}
    DEVICE Bound(uint x, uint y) : x(x), y(y) {}
    DEVICE void operator-=(Bound other) {
        x -= other.x;
        y -= other.y;
    }
    DEVICE bool operator==(Bound other) const { return x == other.x && y == other.y; }
};
#define uint2 Bound

namespace metal {
using ::uint4;
typedef uint atomic_uint;
enum order { memory_order_relaxed };
enum class mem_flags { mem_threadgroup };

DEVICE bool all(bool equal) { return equal; }

DEVICE uint min(uint a, uint b) { return ::min(a, b); }
DEVICE uint max(uint a, uint b) { return ::max(a, b); }

DEVICE float abs(float a) { return fabsf(a); }
DEVICE float min(float a, float b) { return fminf(a, b); }
DEVICE float max(float a, float b) { return fmaxf(a, b); }
DEVICE float floor(float a) { return floorf(a); }
DEVICE float sqrt(float a) { return sqrtf(a); }

DEVICE double abs(double a) { return fabs(a); }
DEVICE double min(double a, double b) { return fmin(a, b); }
DEVICE double max(double a, double b) { return fmax(a, b); }
DEVICE double floor(double a) { return ::floor(a); }
DEVICE double sqrt(double a) { return ::sqrt(a); }

template <typename T> DEVICE T select(T no, T yes, bool which) { return which ? yes : no; }

DEVICE uint atomic_load_explicit(const uint* from, order) { return *(const volatile uint*)from; }
DEVICE void atomic_store_explicit(uint* to, uint value, order) { *(volatile uint*)to = value; }
DEVICE uint atomic_fetch_add_explicit(uint* to, uint value, order) { return atomicAdd(to, value); }
DEVICE uint atomic_fetch_sub_explicit(uint* to, uint value, order) { return atomicSub(to, value); }
DEVICE void threadgroup_barrier(mem_flags) { __syncthreads(); }
} // namespace metal

/* The level of an x86-64 processor, 1 to 4, as the psABI defines it
   (https://gitlab.com/x86-psABIs/x86-64-ABI), if the operating system saves its registers. */

#include <cpuid.h>
#include <stdint.h>

#define BIT(n) (1u << (n))
#define HAS(register, bits) (((register) & (bits)) == (bits))

static const uint32_t v2 = /* SSE3, SSSE3, CMPXCHG16B, SSE4.1, SSE4.2, POPCNT */
    BIT(0) | BIT(9) | BIT(13) | BIT(19) | BIT(20) | BIT(23);
static const uint32_t v3 = /* FMA, MOVBE, XSAVE, OSXSAVE, AVX, F16C */
    BIT(12) | BIT(22) | BIT(26) | BIT(27) | BIT(28) | BIT(29);
static const uint32_t v3_newer = BIT(3) | BIT(5) | BIT(8); /* BMI1, AVX2, BMI2 */
static const uint32_t v3_more = BIT(5);                    /* LZCNT */
static const uint32_t v4_newer = /* AVX-512 F, DQ, CD, BW, VL */
    BIT(16) | BIT(17) | BIT(28) | BIT(30) | BIT(31);
static const uint32_t avx = BIT(1) | BIT(2);
static const uint32_t avx_512 = BIT(1) | BIT(2) | BIT(5) | BIT(6) | BIT(7);

__attribute__((visibility("default"))) int64_t processor_level(void) {
  uint32_t a, b, c, d, basic, newer = 0, more = 0, saved, high;
  if (!__get_cpuid(1, &a, &b, &basic, &d) || !HAS(basic, v2)) return 1;
  if (__get_cpuid_count(7, 0, &a, &b, &c, &d)) newer = b;
  if (__get_cpuid(0x80000001, &a, &b, &c, &d)) more = c;
  if (!HAS(basic, v3) || !HAS(newer, v3_newer) || !HAS(more, v3_more)) return 2;
  __asm__("xgetbv" : "=a"(saved), "=d"(high) : "c"(0));
  if (!HAS(saved, avx)) return 2;
  return HAS(newer, v4_newer) && HAS(saved, avx_512) ? 4 : 3;
}

/* SHA-256 by FIPS 180-4: tells files from each other. */
#include <stdint.h>
#include <string.h>

/* fpm gives C no flags of its own. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("O3")
#endif

/* As `sha256_t` of sha256.f90. */
struct sha256 {
    uint32_t state[8];
    int64_t length; /* of all bytes so far */
    unsigned char block[64];
};

static const uint32_t constants[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2
};

void faststrip_sha256_start(struct sha256 *hash)
{
    static const uint32_t first[8] = {
        0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19
    };

    memcpy(hash->state, first, sizeof first);
    hash->length = 0;
}

static inline __attribute__((always_inline)) uint32_t turned(uint32_t word, int by)
{
    return word >> by | word << (32 - by);
}

/* One of the 64 rounds: only d and h change, so that the names go round instead of the words. */
#define ROUND(a, b, c, d, e, f, g, h, i)                                            \
    do {                                                                            \
        uint32_t high = h + (turned(e, 6) ^ turned(e, 11) ^ turned(e, 25))          \
                        + (g ^ (e & (f ^ g))) + constants[i] + w[i];                \
        d += high;                                                                  \
        h = high + (turned(a, 2) ^ turned(a, 13) ^ turned(a, 22))                   \
            + ((a & b) | (c & (a | b)));                                            \
    } while (0)

static void take_block(uint32_t state[8], const unsigned char *block)
{
    uint32_t a = state[0], b = state[1], c = state[2], d = state[3], e = state[4], f = state[5],
             g = state[6], h = state[7], w[64];
    int i;

    for (i = 0; i < 16; i++)
        w[i] = (uint32_t)block[4 * i] << 24 | (uint32_t)block[4 * i + 1] << 16
               | (uint32_t)block[4 * i + 2] << 8 | block[4 * i + 3];
    for (i = 16; i < 64; i++)
        w[i] = w[i - 16] + w[i - 7]
               + (turned(w[i - 15], 7) ^ turned(w[i - 15], 18) ^ w[i - 15] >> 3)
               + (turned(w[i - 2], 17) ^ turned(w[i - 2], 19) ^ w[i - 2] >> 10);
    for (i = 0; i < 64; i += 8) {
        ROUND(a, b, c, d, e, f, g, h, i);
        ROUND(h, a, b, c, d, e, f, g, i + 1);
        ROUND(g, h, a, b, c, d, e, f, i + 2);
        ROUND(f, g, h, a, b, c, d, e, i + 3);
        ROUND(e, f, g, h, a, b, c, d, i + 4);
        ROUND(d, e, f, g, h, a, b, c, i + 5);
        ROUND(c, d, e, f, g, h, a, b, i + 6);
        ROUND(b, c, d, e, f, g, h, a, i + 7);
    }
    state[0] += a, state[1] += b, state[2] += c, state[3] += d;
    state[4] += e, state[5] += f, state[6] += g, state[7] += h;
}

void faststrip_sha256_add(struct sha256 *hash, const unsigned char *bytes, int64_t n)
{
    int64_t held = hash->length % 64, part;

    hash->length += n;
    while (n > 0) {
        if (held == 0 && n >= 64) {
            take_block(hash->state, bytes);
            part = 64;
        } else {
            part = n < 64 - held ? n : 64 - held;
            memcpy(hash->block + held, bytes, (size_t)part);
            held += part;
            if (held == 64) {
                take_block(hash->state, hash->block);
                held = 0;
            }
        }
        bytes += part;
        n -= part;
    }
}

/* The digest of what was added so far, in 64 hexadecimal digits; more may be added. */
void faststrip_sha256_digest(const struct sha256 *hash, char digest[64])
{
    static const char digits[] = "0123456789abcdef";
    struct sha256 end = *hash;
    uint64_t bits = (uint64_t)hash->length * 8;
    unsigned char rest[72] = { 0x80 };
    int64_t held = hash->length % 64, n = (held < 56 ? 56 : 120) - held;
    int i;

    for (i = 0; i < 8; i++)
        rest[n + i] = (unsigned char)(bits >> (56 - 8 * i));
    faststrip_sha256_add(&end, rest, n + 8);
    for (i = 0; i < 64; i++)
        digest[i] = digits[end.state[i / 8] >> (28 - 4 * (i % 8)) & 15];
}

// StereoMatcherTest.java - frames in the buffers that a camera hands out, through Java and back.
import bsm.StereoMatcher;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.ShortBuffer;

public final class StereoMatcherTest {
  static final int WIDTH = 64, HEIGHT = 48, SHIFT = 5, STRIDE = 80;

  static final class Frame {
    ByteBuffer y, u, v;
  }

  static void check(boolean condition, String what) {
    if (!condition) throw new AssertionError(what);
  }

  static byte noise(int x, int y, int channel) {
    int value = x * 7919 + y * 104729 + channel * 1299709 + 12345;
    value = (value ^ (value >>> 13)) * 0x5bd1e995;
    return (byte) (value >>> 19);
  }

  static ByteBuffer part(ByteBuffer buffer, int from, int bytes) {
    ByteBuffer copy = buffer.duplicate();
    copy.position(from);
    copy.limit(from + bytes);
    return copy.slice();
  }

  // Noise that lies SHIFT pixels further left in the right view. Each chroma plane lacks the byte that is the other's.
  static Frame frame(int shift, int format) {
    ByteBuffer luma = ByteBuffer.allocateDirect(STRIDE * HEIGHT);
    ByteBuffer chroma = ByteBuffer.allocateDirect(STRIDE * HEIGHT / 2);
    int first = format == StereoMatcher.NV12 ? 0 : 1;
    for (int y = 0; y < HEIGHT; ++y) {
      for (int x = 0; x < WIDTH; ++x) luma.put(y * STRIDE + x, noise(x + shift, y, 0));
    }
    for (int y = 0; y < HEIGHT / 2; ++y) {
      for (int x = 0; x < WIDTH / 2; ++x) {
        chroma.put(y * STRIDE + 2 * x + first, (byte) 120);
        chroma.put(y * STRIDE + 2 * x + 1 - first, (byte) 140);
      }
    }
    int bytes = STRIDE * (HEIGHT / 2 - 1) + WIDTH - 1;
    Frame frame = new Frame();
    frame.y = part(luma, 0, STRIDE * (HEIGHT - 1) + WIDTH);
    frame.u = part(chroma, first, bytes);
    frame.v = part(chroma, 1 - first, bytes);
    return frame;
  }

  static ShortBuffer match(int format) {
    Frame left = frame(0, format), right = frame(SHIFT, format);
    check(StereoMatcher.formatOf(left.u, left.v) == format, "formatOf");
    ByteBuffer map = ByteBuffer.allocateDirect(2 * WIDTH * HEIGHT).order(ByteOrder.nativeOrder());
    try (StereoMatcher matcher = new StereoMatcher(WIDTH, HEIGHT, 16, StereoMatcher.FAST, format)) {
      match(matcher, left, right, map);
    }
    return map.asShortBuffer();
  }

  static void match(StereoMatcher matcher, Frame left, Frame right, ByteBuffer map) {
    matcher.match(left.y, STRIDE, left.u, left.v, STRIDE, right.y, STRIDE, right.u, right.v, STRIDE, map);
  }

  static void refuses(String what, Runnable call) {
    try {
      call.run();
    } catch (IllegalArgumentException | IllegalStateException expected) {
      return;
    }
    throw new AssertionError(what + " is not refused");
  }

  public static void main(String[] arguments) {
    ShortBuffer nv12 = match(StereoMatcher.NV12), nv21 = match(StereoMatcher.NV21);
    int right = 0;
    for (int i = 0; i < WIDTH * HEIGHT; ++i) right += Math.abs(nv12.get(i) - 16 * SHIFT) <= 8 ? 1 : 0;
    check(right > WIDTH * HEIGHT * 8 / 10, "most pixels have the true disparity, " + right + " have");
    check(nv12.equals(nv21), "the same colours give the same map in NV12 and NV21");

    Frame a = frame(0, StereoMatcher.NV12), b = frame(SHIFT, StereoMatcher.NV12);
    ByteBuffer map = ByteBuffer.allocateDirect(2 * WIDTH * HEIGHT);
    StereoMatcher matcher = new StereoMatcher(WIDTH, HEIGHT, 16, StereoMatcher.FAST, StereoMatcher.NV12);
    refuses("a small map", () -> match(matcher, a, b, part(map, 0, 2 * WIDTH * HEIGHT - 1)));
    refuses("a heap buffer", () -> match(matcher, a, b, ByteBuffer.allocate(2 * WIDTH * HEIGHT)));
    refuses("no buffer", () -> match(matcher, a, b, null));
    refuses("the other order", () -> match(matcher, a, frame(SHIFT, StereoMatcher.NV21), map));
    refuses("separate planes", () -> StereoMatcher.formatOf(a.u, b.v));
    refuses("a short stride",
        () -> matcher.match(a.y, WIDTH - 1, a.u, a.v, STRIDE, b.y, STRIDE, b.u, b.v, STRIDE, map));
    refuses("a stride beyond the buffer",
        () -> matcher.match(a.y, STRIDE + 1, a.u, a.v, STRIDE, b.y, STRIDE, b.u, b.v, STRIDE, map));
    matcher.close();
    matcher.close();
    refuses("a closed matcher", () -> match(matcher, a, b, map));
    refuses("an odd width", () -> new StereoMatcher(WIDTH + 1, HEIGHT, 16, StereoMatcher.FAST, StereoMatcher.NV12));
    refuses("no disparities", () -> new StereoMatcher(WIDTH, HEIGHT, 0, StereoMatcher.FAST, StereoMatcher.NV12));
    refuses("an unknown preset", () -> new StereoMatcher(WIDTH, HEIGHT, 16, 9, StereoMatcher.NV12));
    refuses("an unknown format", () -> new StereoMatcher(WIDTH, HEIGHT, 16, StereoMatcher.FAST, 0));
    System.out.println("ok: Android");
  }
}

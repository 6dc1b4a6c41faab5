/* picture_mean FILE [X0 Y0 X1 Y1]: width, height, and the means of red, green and blue, 0 to 255, of a PNG or of a
 * rectangle of it; for scripts that look at pictures. */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
  png_image image;
  memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  if ((argc != 2 && argc != 6) || !png_image_begin_read_from_file(&image, argv[1])) {
    fprintf(stderr, "picture_mean: %s\n", argc == 2 || argc == 6 ? image.message : "FILE [X0 Y0 X1 Y1]");
    return 1;
  }
  image.format = PNG_FORMAT_RGB;
  png_byte *pixels = malloc(PNG_IMAGE_SIZE(image));
  if (!pixels || !png_image_finish_read(&image, NULL, pixels, 0, NULL)) {
    fprintf(stderr, "picture_mean: %s\n", image.message);
    return 1;
  }
  unsigned rect[4] = {0, 0, image.width, image.height};
  for (int i = 0; i < 4 && argc == 6; ++i) rect[i] = (unsigned)strtoul(argv[2 + i], NULL, 10);
  if (rect[0] >= rect[2] || rect[1] >= rect[3] || rect[2] > image.width || rect[3] > image.height) {
    fprintf(stderr, "picture_mean: no such rectangle in %u x %u pixels\n", image.width, image.height);
    return 1;
  }
  double sum[3] = {0, 0, 0}, n = (double)(rect[2] - rect[0]) * (rect[3] - rect[1]);
  for (size_t y = rect[1]; y < rect[3]; ++y)
    for (size_t x = rect[0]; x < rect[2]; ++x)
      for (size_t c = 0; c < 3; ++c) sum[c] += pixels[(y * image.width + x) * 3 + c];
  printf("%u %u %.2f %.2f %.2f\n", image.width, image.height, sum[0] / n, sum[1] / n, sum[2] / n);
  free(pixels);
  return 0;
}

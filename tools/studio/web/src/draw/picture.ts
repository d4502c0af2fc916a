// Saves a picture that is there as SVG.
import { download, savePng } from './save';

export const saveSvg = (name: string, svg: string): void => download(`${name}.svg`, 'image/svg+xml', svg);

/** Saves it as PNG, with `scale` pixels for each of its units, and fewer if the browser has no canvas of that size. */
export async function saveSvgAsPng(name: string, svg: string, scale = 2): Promise<void> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const part = Math.min(scale, 8000 / Math.max(image.width, image.height));
  const canvas = document.createElement('canvas');
  canvas.width = Math.ceil(image.width * part);
  canvas.height = Math.ceil(image.height * part);
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  savePng(name, canvas);
}

// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Finds faces on a thread of its own, by the BlazeFace network in WebAssembly. No picture leaves it.
import { setWasmPaths } from '@tensorflow/tfjs-backend-wasm';
import wasmUrl from '@tensorflow/tfjs-backend-wasm/dist/tfjs-backend-wasm-simd.wasm?url';
import { loadGraphModel, type GraphModel } from '@tensorflow/tfjs-converter';
import { dispose, io, setBackend, tensor, type Tensor } from '@tensorflow/tfjs-core';
import weightsUrl from 'head-model/blazeface.bin?url';
import modelUrl from 'head-model/blazeface.json?url';
import { facesIn, followed, inputSide, squareAround, wholeSquare, type Face, type Square } from './faces';
import type { FacePoints } from './place';

/** To the worker: a picture, which it closes. */
export interface Look {
  picture: ImageBitmap;
  /** When it was taken, milliseconds. */
  time: number;
}
/** From the worker: `ready` once, then an answer to each look; `failed`: nothing can be found. */
export type Found =
  | { type: 'ready' }
  | { type: 'failed' }
  | { type: 'looked'; time: number; width: number; height: number; points: FacePoints | null; faces: number };

/** The whole picture is searched for further faces once in so many pictures. */
const lookAround = 30;

const canvas = new OffscreenCanvas(inputSide, inputSide);
const context = canvas.getContext('2d', { willReadFrequently: true })!;
const input = new Float32Array(3 * inputSide * inputSide);
let last: FacePoints | null = null;
let looks = 0;
let faces = 0;

async function load(): Promise<GraphModel> {
  // All names must be given. Threads need pages that are isolated from other origins, which these are not; a browser without
  // SIMD cannot compile the file.
  setWasmPaths({ 'tfjs-backend-wasm.wasm': wasmUrl, 'tfjs-backend-wasm-simd.wasm': wasmUrl, 'tfjs-backend-wasm-threaded-simd.wasm': wasmUrl });
  if (!(await setBackend('wasm'))) throw new Error('no WebAssembly');
  const [{ modelTopology, weightsManifest }, weightData] = await Promise.all([
    fetch(modelUrl).then((answer) => answer.json() as Promise<io.ModelJSON>),
    fetch(weightsUrl).then((answer) => answer.arrayBuffer()),
  ]);
  return loadGraphModel(io.fromMemory({ modelTopology, weightSpecs: weightsManifest.flatMap(({ weights }) => weights), weightData }));
}

function facesAt(model: GraphModel, picture: ImageBitmap, square: Square): Face[] {
  const scale = inputSide / square.side;
  context.clearRect(0, 0, inputSide, inputSide);
  context.drawImage(picture, -square.left * scale, -square.top * scale, picture.width * scale, picture.height * scale);
  const { data } = context.getImageData(0, 0, inputSide, inputSide);
  for (let from = 0, to = 0; from < data.length; from += 4)
    for (let colour = 0; colour < 3; ++colour) input[to++] = data[from + colour]! / 127.5 - 1;
  const pixels = tensor(input, [1, inputSide, inputSide, 3]);
  const outputs = model.execute(pixels) as Tensor[];
  // Of each grid the logits and the boxes; the first grid has more candidates.
  const [coarse, fine, coarseBoxes, fineBoxes] = [...outputs].sort((a, b) => a.size - b.size).map((output) => output.dataSync());
  const found = facesIn(joined(fine!, coarse!), joined(fineBoxes!, coarseBoxes!), square);
  dispose([pixels, ...outputs]);
  return found;
}

function joined(a: ArrayLike<number>, b: ArrayLike<number>): Float32Array {
  const both = new Float32Array(a.length + b.length);
  both.set(a);
  both.set(b, a.length);
  return both;
}

function look(model: GraphModel, { picture, time }: Look): Found {
  const { width, height } = picture;
  const near = last === null ? [] : facesAt(model, picture, squareAround(last, width, height));
  const wide = near.length === 0 || looks % lookAround === 0 ? facesAt(model, picture, wholeSquare(width, height)) : [];
  looks += 1;
  picture.close();
  if (wide.length > 0 || near.length === 0) faces = wide.length;
  const face = followed(near.length > 0 ? near : wide, last);
  last = face?.points ?? null;
  return { type: 'looked', time, width, height, points: last, faces };
}

const post = (message: Found) => postMessage(message);
load().then(
  (model) => {
    onmessage = ({ data }: MessageEvent<Look>) => post(look(model, data));
    post({ type: 'ready' });
  },
  () => post({ type: 'failed' }),
);

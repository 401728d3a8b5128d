// The bytes of an IFC file: of the file itself, or of the one in a zip archive (.ifczip).
import { closeSync, fstatSync, openSync, readSync } from 'node:fs';
import { inflateRawSync } from 'node:zlib';

/** A function (offset, size) that gives so many bytes, fewer at the end; and the size of all. */
export function openIfc(path) {
  const descriptor = openSync(path, 'r');
  const size = fstatSync(descriptor).size;
  const read = (offset, wanted) => {
    const bytes = Buffer.alloc(Math.max(Math.min(wanted, size - offset), 0));
    let done = 0;
    while (done < bytes.length) {
      const count = readSync(descriptor, bytes, done, bytes.length - done, offset + done);
      if (count === 0) break;
      done += count;
    }
    return bytes.subarray(0, done);
  };
  if (read(0, 4).toString('latin1') !== 'PK\x03\x04') return { read, size };
  const text = unzip(read, size);
  closeSync(descriptor);
  return { read: (offset, wanted) => text.subarray(offset, offset + wanted), size: text.length };
}

function unzip(read, size) {
  const tailBytes = Math.min(size, 65557);
  const tail = read(size - tailBytes, tailBytes);
  const end = tail.lastIndexOf(Buffer.from('PK\x05\x06', 'latin1'));
  if (end < 0 || end + 22 > tail.length) throw new Error('is a zip archive without a table of contents; it was cut');
  const directory = read(tail.readUInt32LE(end + 16), tail.readUInt32LE(end + 12));
  for (let at = 0; at + 46 <= directory.length && directory.readUInt32LE(at) === 0x02014b50;) {
    const nameBytes = directory.readUInt16LE(at + 28);
    const name = directory.toString('utf8', at + 46, at + 46 + nameBytes);
    if (/\.ifc$/i.test(name)) return unpack(read, directory.subarray(at));
    at += 46 + nameBytes + directory.readUInt16LE(at + 30) + directory.readUInt16LE(at + 32);
  }
  throw new Error('is a zip archive without an .ifc file');
}

function unpack(read, entry) {
  const method = entry.readUInt16LE(10);
  const packedBytes = entry.readUInt32LE(20);
  const offset = entry.readUInt32LE(42);
  const header = read(offset, 30);
  if (header.length < 30) throw new Error('is a zip archive whose .ifc file lies beyond its end');
  const packed = read(offset + 30 + header.readUInt16LE(26) + header.readUInt16LE(28), packedBytes);
  if (method === 0) return packed;
  if (method !== 8) throw new Error(`is a zip archive packed by method ${method}; only deflate is known`);
  try {
    return inflateRawSync(packed);
  } catch (error) {
    throw new Error(`is a zip archive whose .ifc file does not unpack: ${error.message}`);
  }
}

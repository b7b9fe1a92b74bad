//! Arbitrary bytes, and spoilt objects, where a store looks for the object of a key: never served unless they are the
//! very bytes that were written.

use std::cell::RefCell;
use std::sync::Arc;

use bytes::Bytes;
use object_store::memory::InMemory;
use object_store::path::Path;
use object_store::{ObjectStore, ObjectStoreExt};
use tokio::runtime::Runtime;
use verne_store::{Key, Store};

use crate::draw::Draw;

thread_local! {
    static RUNTIME: RefCell<Runtime> = RefCell::new(tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap());
}

/// Bytes of memory: none, so that each question goes below.
const NOTHING: u64 = 0;

/// Something lies where an object is looked for.
pub(crate) fn store(bytes: &[u8]) {
    RUNTIME.with_borrow(|runtime| runtime.block_on(ask(Draw::new(bytes))));
}

async fn ask(mut draw: Draw<'_>) {
    let key = Key::from([draw.below(3).try_into().unwrap(); 32]);
    let digits = key.to_string();
    let place = Path::from_iter([&digits[..2], &digits[2..]]);
    let content = Bytes::from(vec![draw.byte(); draw.pick(&[0, 1, 100, 1000])]);
    let good = object(key, &content, &place).await;
    let lying = if draw.one_in(4) { draw.rest().to_vec() } else { spoilt(&mut draw, &good) };
    let objects = Arc::new(InMemory::new());
    objects.put(&place, lying.clone().into()).await.unwrap();
    let store = Store::open_shared_over(Arc::clone(&objects) as Arc<dyn ObjectStore>, NOTHING).await.unwrap();
    let same = lying == good;
    let found = store.get(&key).await.map(|content| content.bytes);
    assert_eq!(found, same.then_some(content));
    assert!(
        same || objects.head(&place).await.is_err() || store.stats().read_failures > 0,
        "damage is removed"
    );
}

/// The object of a content, as the store writes it.
async fn object(key: Key, content: &Bytes, place: &Path) -> Vec<u8> {
    let objects = Arc::new(InMemory::new());
    let store = Store::open_shared_over(Arc::clone(&objects) as Arc<dyn ObjectStore>, NOTHING).await.unwrap();
    store.put(&key, content.clone()).await;
    objects.get(place).await.unwrap().bytes().await.unwrap().to_vec()
}

/// An object with some bytes changed, cut off or added.
fn spoilt(draw: &mut Draw<'_>, good: &[u8]) -> Vec<u8> {
    let mut object = good.to_vec();
    for _ in 0..draw.below(4) {
        let at = (draw.below(256) * 256 + draw.below(256)) % object.len().max(1);
        match draw.below(6) {
            0..3 if at < object.len() => object[at] ^= draw.byte(),
            3 => object.truncate(at),
            4 => object.extend(draw.some_bytes()),
            // The length that it states.
            _ if object.len() > 20 => {
                object[12..20].copy_from_slice(&draw.number(1e9).to_bits().to_le_bytes());
            }
            _ => {}
        }
    }
    object
}
